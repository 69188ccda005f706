// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/solvers.h"
#include "fixtures.h"

#include <myolines/time/integrator.h>

#include <gtest/gtest.h>

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
    void go(const std::string &method, const unsigned int steps, const double end, const Visitor &visit)
    {
      const IntegratorEntry &entry = integrator_entry(method);
      const auto             integrator =
          entry.make(myolines::testing::node(entry.schema), {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
      integrator->start(state);
      visit(state);
      for (unsigned int i = 0; i < steps; ++i)
        {
          const StepReport report = integrator->step(end / steps, state);
          ASSERT_TRUE(report.accepted()) << report.reason;
          visit(state);
        }
    }

    myolines::testing::Solvers solvers;
    Muscle3dSystem             system;
    State                      state;
  };
} // namespace myolines::test
