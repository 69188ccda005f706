// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/solvers.h"

#include <myolines/muscle1d/isometric_chain.h>
#include <myolines/muscle1d/muscle_tendon_unit.h>
#include <myolines/time/error_control.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/loop.h>

#include <gtest/gtest.h>

#include <optional>
#include <sstream>

namespace myolines::testing
{
  inline std::string text(const double value)
  {
    std::ostringstream stream;
    stream.precision(17);
    stream << value;
    return stream.str();
  }

  /// A muscle with a method whose steps are chosen by error, landing at the instants of a table.
  struct MuscleRun
  {
    MuscleRun(Muscle1dParameters parameters, const std::string &method, const Overrides &control)
      : solvers({"relative tolerance=1e-10", "absolute tolerance=1e-12"})
      , system(std::move(parameters), solvers.ledger)
      , entry(integrator_entry(method))
      , settings{"step=1e-5", "control/type=error"}
    {
      settings.insert(settings.end(), control.begin(), control.end());
      state = system.initial_state(0);
    }

    /// Through the ascending @p landings to the last one; calls @p see at each.
    void go(const std::vector<double> &landings, const std::function<void(const State &)> &see)
    {
      settings.push_back("end=" + text(landings.back()));
      const scene::Node       time = node(time_schema(), settings);
      const auto              norm = make_error_norm(time, system);
      const IntegratorContext context{system,         solvers.nonlinear,         BoundaryRates::exact,
                                      solvers.ledger, StartVelocity::consistent, norm.get()};
      struct Watch : Observer
      {
        void accepted(const State &s, const StepRecord &) override
        {
          if (next < times.size() && s.t == times[next])
            {
              ++next;
              see(s);
            }
        }
        std::vector<double>                times;
        std::function<void(const State &)> see;
        std::size_t                        next = 0;
      } watch;
      watch.times       = landings;
      watch.see         = see;
      LoopSettings loop = loop_settings(time);
      loop.landings.assign(landings.begin(), landings.end() - 1);
      if (entry.make_self_paced)
        run_loop(system, *entry.make_self_paced(node(entry.schema), context, error_control_limits(time)), loop, state, {&watch},
                 solvers.ledger);
      else
        run_loop(system, *make_integrator(entry, node(entry.schema), context), *make_step_control(time, error_exponent(entry.facts)), loop,
                 state, {&watch}, solvers.ledger);
      EXPECT_EQ(watch.next, landings.size());
    }

    Solvers                solvers;
    Muscle1dSystem         system;
    const IntegratorEntry &entry;
    Overrides              settings;
    State                  state;
  };

  inline Overrides tolerances(const double relative, const double absolute, const bool velocity)
  {
    Overrides all;
    for (const std::string block : {"displacement", "velocity"})
      if (block == "displacement" || velocity)
        all.insert(all.end(), {"control/" + block + "/relative tolerance=" + text(relative),
                               "control/" + block + "/absolute tolerance=" + text(absolute)});
    return all;
  }

  inline Overrides unit_settings(const std::string &input, const std::string &scale, const std::string &masses)
  {
    Overrides all{"scale=" + scale, "masses=" + masses};
    if (input == "strong")
      all.insert(all.end(), {"input/base=0.9", "input/amplitude=4"});
    return all;
  }
} // namespace myolines::testing
