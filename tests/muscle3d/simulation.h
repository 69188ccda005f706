// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/solvers.h"
#include "fixtures.h"

#include <myolines/time/error_control.h>
#include <myolines/time/integrator.h>
#include <myolines/time/loop.h>

#include <gtest/gtest.h>

#include <sstream>

namespace myolines::test
{
  /// A muscle with solvers, advanced by fixed steps of an integrator.
  struct Simulation
  {
    explicit Simulation(Muscle3dParameters parameters, const myolines::testing::Overrides &nonlinear = {"relative tolerance=1e-10"})
      : solvers(nonlinear, {}, {"type=direct"})
      , system(std::move(parameters), MPI_COMM_WORLD, solvers.ledger)
      , state(system.initial_state(0))
    {}

    /// Visits the state at the beginning and after every step.
    template <typename Visitor>
    void go(const std::string &method, const unsigned int steps, const double end, const Visitor &visit,
            const myolines::testing::Overrides &of_method = {})
    {
      const IntegratorEntry &entry = integrator_entry(method);
      const auto             integrator =
          entry.make(myolines::testing::node(entry.schema, of_method), {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
      integrator->start(state);
      visit(state);
      for (unsigned int i = 0; i < steps; ++i)
        {
          const StepReport report = integrator->step(end / steps, state);
          ASSERT_TRUE(report.accepted()) << report.reason;
          visit(state);
        }
    }

    /// To @p end in steps that the method chooses, within absolute tolerances.
    void go_within(const IntegratorEntry &method, const double displacement, const double velocity, const double end)
    {
      const auto text = [](const double x) {
        std::ostringstream out;
        out << x;
        return out.str();
      };
      const scene::Node time = myolines::testing::node(
          time_schema(), {"end=" + text(end), "step=" + text(end / 1000), "control/type=error", "control/displacement/relative tolerance=0",
                          "control/displacement/absolute tolerance=" + text(displacement), "control/velocity/relative tolerance=0",
                          "control/velocity/absolute tolerance=" + text(velocity)});
      const auto norm = make_error_norm(time, system);
      const auto integrator =
          method.make_self_paced(myolines::testing::node(method.schema),
                                 {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger, StartVelocity::consistent, norm.get()},
                                 error_control_limits(time));
      integrator->start(state);
      while (state.t < end)
        {
          const StepReport report = integrator->advance(end, state);
          ASSERT_TRUE(report.accepted()) << report.reason;
        }
    }

    myolines::testing::Solvers solvers;
    Muscle3dSystem             system;
    State                      state;
  };
} // namespace myolines::test
