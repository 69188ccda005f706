// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/drives.h"
#include "../support/solvers.h"
#include "cases.h"

#include <myolines/oscillator/oscillator_system.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/loop.h>

#include <algorithm>
#include <ostream>

namespace myolines
{
  /// For the names of parameterised tests.
  inline void PrintTo(const IntegratorEntry &entry, std::ostream *stream) { *stream << entry.facts.name; }
} // namespace myolines

namespace myolines::testing
{
  /// An oscillator, the solvers and one integrator, as a run puts them together.
  class Experiment
  {
  public:
    static Overrides tight() { return {"relative tolerance=1e-13", "absolute tolerance=0"}; }

    Experiment(const IntegratorEntry &entry, OscillatorParameters parameters, const BoundaryRates rates = BoundaryRates::exact,
               const Overrides &method = {}, const Overrides &nonlinear = tight())
      : solvers(nonlinear)
      , system(std::move(parameters), solvers.ledger)
      , integrator(make_integrator(entry, node(entry.schema, method), IntegratorContext{system, solvers.nonlinear, rates, solvers.ledger}))
      , state(system.initial_state(0))
    {}

    /// Runs from the present state to @p end with the steps of @p n equal ones from 0.
    void run(const double end, const double step, const std::vector<Observer *> &observers = {})
    {
      std::ostringstream size, until;
      size.precision(17);
      until.precision(17);
      size << "step=" << step;
      until << "end=" << end;
      const scene::Node time    = node(time_schema(), {until.str(), size.str(), "control/type=fixed"});
      const auto        control = make_step_control(time);
      run_loop(system, *integrator, *control, loop_settings(time), state, observers, solvers.ledger);
    }

    Solvers                     solvers;
    OscillatorSystem            system;
    std::unique_ptr<Integrator> integrator;
    State                       state;
  };

  /// A cubic spring, damped, driven by a force and by its support.
  inline OscillatorParameters driven_duffing()
  {
    OscillatorParameters parameters;
    parameters.cubic_stiffness = 3;
    parameters.damping         = 0.2;
    parameters.force           = sine(2, 3);
    parameters.support         = sine(0.5, 2);
    return parameters;
  }

  /// All numbers of @p state.
  inline std::vector<double> values(const State &state)
  {
    std::vector<double> all = {state.t};
    for (const Vector *x : {&state.u, &state.v, &state.a})
      all.insert(all.end(), x->begin(), x->end());
    return all;
  }

  /// @p settings of the list `time` with steps chosen by error until @p end, from a first one of 1 ms if they name none.
  inline Overrides by_error(Overrides settings, const double end)
  {
    std::ostringstream until;
    until.precision(17);
    until << "end=" << end;
    settings.insert(settings.end(), {"control/type=error", until.str()});
    if (std::none_of(settings.begin(), settings.end(), [](const std::string &s) { return s.rfind("step=", 0) == 0; }))
      settings.push_back("step=1e-3");
    return settings;
  }

  /// Methods of the list whose steps are ours to choose.
  inline std::vector<IntegratorEntry> native_methods()
  {
    std::vector<IntegratorEntry> methods;
    for (const MethodCases &method : method_cases())
      if (!method.entry.make_self_paced)
        methods.push_back(method.entry);
    return methods;
  }

  /// A case with the method it belongs to.
  struct Verified
  {
    IntegratorEntry entry;
    Case            facts;
  };

  inline std::vector<Verified> all_cases()
  {
    std::vector<Verified> all;
    for (const MethodCases &method : method_cases())
      for (const Case &c : method.cases)
        all.push_back({method.entry, c});
    return all;
  }

  inline void PrintTo(const Verified &verified, std::ostream *stream) { *stream << verified.facts.label; }
} // namespace myolines::testing
