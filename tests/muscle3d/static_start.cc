// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs that start from static equilibrium.
#include "simulation.h"

#include <myolines/base/error.h>
#include <myolines/muscle3d/body_measures.h>
#include <myolines/time/start.h>

namespace myolines
{
  namespace
  {
    /// The idealised gastrocnemius, passive: its aponeurosis pulls even at rest. Held at its ends.
    Muscle3dParameters resting_gastrocnemius()
    {
      Muscle3dParameters p;
      p.n_points                                = 3;
      p.geometry.gastrocnemius                  = Gastrocnemius();
      p.geometry.size                           = {{0.27, 0.055, 0.023}};
      p.geometry.cells                          = {{4, 4, 2}};
      p.geometry.refinement                     = 0;
      p.tissues[aponeurosis_id]                 = tissue_kinds()[aponeurosis_id - 1].defaults;
      p.muscle().fibre.direction                = p.geometry.gastrocnemius->fibre_direction();
      p.tissues[aponeurosis_id].fibre.direction = p.geometry.gastrocnemius->aponeurosis_direction();
      for (const unsigned int face : {0u, 1u})
        p.boundary.push_back(test::held(face));
      return p;
    }

    IntegratorContext context(test::Simulation &simulation)
    {
      return {simulation.system, simulation.solvers.nonlinear, BoundaryRates::exact, simulation.solvers.ledger};
    }

    /// Largest change of the reaction of one end and largest speed within 10 ms, in parts of the reaction and in m/s.
    std::pair<double, double> unrest(const bool from_equilibrium)
    {
      test::Simulation simulation(resting_gastrocnemius());
      if (from_equilibrium)
        {
          start_from_equilibrium(context(simulation), simulation.state);
          EXPECT_EQ(simulation.solvers.ledger.counted("starts from equilibrium"), 1u);
          EXPECT_EQ(simulation.solvers.ledger.counted("load steps"), 1u);
        }
      std::vector<dealii::Tensor<1, 3>> reactions;
      double                            speed = 0;
      simulation.go("backward euler", 5, 0.01, [&](const State &state) {
        reactions.push_back(measure_reactions(simulation.system, state)[1].force);
        speed = std::max(speed, state.v.linfty_norm());
      });
      double change = 0;
      for (const auto &reaction : reactions)
        change = std::max(change, (reaction - reactions.back()).norm());
      return {change / reactions.back().norm(), speed};
    }

    TEST(StaticStart, APrestressedAponeurosisStaysAtRest)
    {
      const auto [change, speed] = unrest(true);
      EXPECT_LT(change, 1e-6);
      EXPECT_LT(speed, 1e-8);
    }

    TEST(StaticStart, WithoutItTheBodyMoves)
    {
      const auto [change, speed] = unrest(false);
      EXPECT_GT(change, 1e-2);
      EXPECT_GT(speed, 1e-4);
    }

    /// It is what the quasi-static system gives, whatever the rates of the boundary.
    TEST(StaticStart, IsTheQuasiStaticSolution)
    {
      Muscle3dParameters p = test::small_block(2, 3, 1);
      p.activation         = std::make_shared<test::ConstantDrive>(0.2);
      p.boundary           = {test::held(0), test::condition("formula", 1, {"displacement x=1e-3+0.1*t", "velocity x=0.1"})};
      test::Simulation dynamic(p);
      start_from_equilibrium(context(dynamic), dynamic.state);
      p.dynamic = false;
      test::Simulation quasi_static(p);
      quasi_static.state.u = dynamic.state.u; // where it stays
      quasi_static.go("static", 1, 1e-9, [](const State &) {});
      Vector difference = dynamic.state.u;
      difference -= quasi_static.state.u;
      EXPECT_LT(difference.linfty_norm(), 1e-9);
      EXPECT_GT(dynamic.state.u.linfty_norm(), 1e-3);
      const auto face = dynamic.system.discretisation().space->face_nodes(1);
      EXPECT_EQ(dynamic.state.v(3 * face.front()), 0.1); // as given
    }

    /// A start that Newton's method does not reach at once comes in parts; one that no part reaches is an error.
    TEST(StaticStart, ComesInPartsWhereItMust)
    {
      Muscle3dParameters p = test::small_block(2, 3, 1);
      p.activation         = std::make_shared<test::ConstantDrive>(0.2);
      p.boundary           = {test::held(0)};
      test::Simulation whole(p), parts(p, {"relative tolerance=1e-10", "maximum iterations=4"});
      start_from_equilibrium(context(whole), whole.state);
      start_from_equilibrium(context(parts), parts.state);
      EXPECT_GT(parts.solvers.ledger.counted("load steps"), 2u);
      Vector difference = whole.state.u;
      difference -= parts.state.u;
      EXPECT_LT(difference.linfty_norm(), 1e-9);

      test::Simulation never(p, {"maximum iterations=1", "relative tolerance=1e-14"});
      EXPECT_THROW(start_from_equilibrium(context(never), never.state), SolveError);
    }
  } // namespace
} // namespace myolines
