#pragma once

#include "../support/solvers.h"

#include <myolines/rod1d/rod1d_system.h>
#include <myolines/time/loop.h>
#include <myolines/time/start.h>

namespace myolines::testing
{
  /// A rod in the conventions of the thesis: scheme rates, kinks landed on, everything at rest at the start.
  struct Rod
  {
    Rod(Rod1dParameters parameters, const std::string &method, const Overrides &settings = {}, const Overrides &time = {},
        const Overrides &nonlinear = {"relative tolerance=1e-12", "absolute tolerance=1e-12"})
      : solvers(nonlinear)
      , system(std::move(parameters), solvers.ledger)
      , time_settings{"boundary rates=scheme", "start velocity=impulse", "events=land", "control/type=fixed"}
    {
      time_settings.insert(time_settings.end(), time.begin(), time.end());
      const scene::Node any   = time_node(1, 1);
      const auto       &entry = integrator_entry(method);
      integrator =
          entry.make(node(entry.schema, settings), {system, solvers.nonlinear, boundary_rates(any), solvers.ledger, start_velocity(any)});
      state = starting_state(system, 0, boundary_rates(any), start_velocity(any));
    }

    scene::Node time_node(const double end, const double step) const
    {
      std::ostringstream size, until;
      size.precision(17);
      until.precision(17);
      size << "step=" << step;
      until << "end=" << end;
      Overrides all = time_settings;
      all.insert(all.end(), {until.str(), size.str()});
      return node(time_schema(), all);
    }

    void run(const double end, const double step, const std::vector<Observer *> &observers = {})
    {
      const scene::Node time    = time_node(end, step);
      const auto        control = make_step_control(time);
      run_loop(system, *integrator, *control, loop_settings(time), state, observers, solvers.ledger);
    }

    Solvers                     solvers;
    Rod1dSystem                 system;
    Overrides                   time_settings;
    std::unique_ptr<Integrator> integrator;
    State                       state;
  };
} // namespace myolines::testing
