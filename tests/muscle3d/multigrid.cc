// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/solvers.h"
#include "fixtures.h"

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    struct MultigridCase
    {
      unsigned int degree, n_points, refinement;
      double       activation, bulk_modulus;
      bool         distorted, exact_tangent;
      unsigned int most_iterations; ///< to 1e-6
      double       swelling = 0;
    };

    /// A muscle linearised at a smooth state; solves with a random right-hand side.
    struct Problem
    {
      explicit Problem(const MultigridCase &c)
        : Problem(parameters(c), c)
      {}

      Problem(const Muscle3dParameters &p, const MultigridCase &c)
        : system(p, MPI_COMM_WORLD, ledger)
      {
        if (c.distorted)
          system.move_mesh(test::distort);
        state             = system.initial_state(0);
        const auto &space = *system.discretisation().space;
        // A volumetric stress that balances the active one across the fibres, as at equilibrium, and c.swelling beyond.
        const double swelling = 7e4 * c.activation / c.bulk_modulus + c.swelling;
        for (const auto node : space.nodes().locally_owned_dofs())
          {
            const auto &x         = space.node_position(node);
            state.u(3 * node)     = swelling * x[0];
            state.u(3 * node + 1) = 0.5 * x[0] * x[2];
            state.u(3 * node + 2) = x[0] * x[0];
            state.v(3 * node)     = 2 * x[0];
            state.v(3 * node + 1) = 30 * x[0] * x[2];
          }
        state.u.update_ghost_values();
        state.v.update_ghost_values();
        linearisation = system.make_linearisation();
        linearise();
        b = space.make_vector();
        test::randomise(b, 1, 5);
        symmetric = system.capabilities().symmetric_tangent;
      }

      void linearise() { system.linearise({0, Side::right, state.u, state.v, state.a}, *linearisation); }

      static Muscle3dParameters parameters(const MultigridCase &c)
      {
        Muscle3dParameters p    = test::small_block(c.degree, c.n_points, c.refinement);
        p.activation            = c.activation > 0 ? std::make_shared<test::ConstantDrive>(c.activation) : nullptr;
        p.exact_tangent         = c.exact_tangent;
        p.muscle().bulk_modulus = c.bulk_modulus;
        p.boundary              = {test::held(0)};
        return p;
      }

      std::pair<LinearReport, Vector> solve(const std::string &type, const std::string &form, const double tolerance)
      {
        testing::Solvers solvers({}, {"operator=" + form}, {"type=" + type});
        Vector           x(b);
        const auto       report =
            solvers.linear.solve(*linearisation, stage_weights(1, 40, 1600), system.constraints(), symmetric, b, x, tolerance);
        return {report, x};
      }

      WorkLedger                     ledger;
      Muscle3dSystem                 system;
      State                          state;
      std::unique_ptr<Linearisation> linearisation;
      Vector                         b;
      bool                           symmetric;
    };

    class PMultigrid : public ::testing::TestWithParam<MultigridCase>
    {
    };

    TEST_P(PMultigrid, SolvesLikeTheFactorisationInFewIterations)
    {
      Problem problem(GetParam());
      const auto [report, x]     = problem.solve("p multigrid", "matrix-free", 1e-6);
      auto [reference, expected] = problem.solve("direct", "assembled", 1e-10);
      EXPECT_TRUE(report.converged) << report.reason;
      EXPECT_TRUE(reference.converged) << reference.reason;
      EXPECT_LE(report.iterations, GetParam().most_iterations);
      expected -= x;
      EXPECT_LT(expected.l2_norm(), 1e-3 * x.l2_norm());
    }

    INSTANTIATE_TEST_SUITE_P(States, PMultigrid,
                             ::testing::Values(MultigridCase{2, 3, 2, 0, 1e7, false, true, 60},    // passive: symmetric, CG
                                               MultigridCase{2, 3, 2, 1, 1e7, false, true, 60},    // fully active: GMRES
                                               MultigridCase{2, 4, 2, 0.5, 1e7, false, false, 60}, // symmetrised, lean quadrature
                                               MultigridCase{2, 3, 2, 0.5, 1e6, true, true, 60},   // no cell is a parallelepiped
                                               MultigridCase{2, 3, 2, 0.5, 1e8, false, true, 60},  //
                                               MultigridCase{3, 4, 1, 0.5, 1e7, true, true, 60}));

    TEST(PMultigridSolver, GivesTheSameWithEitherFormOfTheOperator)
    {
      Problem problem({2, 3, 1, 1, 1e7, true, true, 0});
      const auto [free, x] = problem.solve("p multigrid", "matrix-free", 1e-11);
      auto [assembled, y]  = problem.solve("p multigrid", "assembled", 1e-11);
      EXPECT_TRUE(free.converged && assembled.converged);
      y -= x;
      EXPECT_LT(y.l2_norm(), 1e-8 * x.l2_norm());
    }

    TEST(PMultigridSolver, SurvivesAnIndefiniteTangent)
    {
      Problem problem({2, 3, 1, 1, 1e7, false, true, 0, 0.02});
      const auto [report, x]     = problem.solve("p multigrid", "automatic", 1e-6);
      auto [reference, expected] = problem.solve("direct", "automatic", 1e-10);
      EXPECT_TRUE(report.converged) << report.reason;
      expected -= x;
      EXPECT_LT(expected.l2_norm(), 1e-3 * x.l2_norm());
    }

    TEST(PMultigridSolver, AssemblesNoMatrixAndSmoothsOnTheLeanQuadrature)
    {
      for (const unsigned int n_points : {3u, 5u})
        {
          Problem problem({2, n_points, 1, 1, 1e7, false, true, 0});
          EXPECT_TRUE(problem.solve("p multigrid", "automatic", 1e-3).first.converged);
          EXPECT_EQ(problem.ledger.counted("matrix assemblies"), 0u);
          EXPECT_EQ(problem.ledger.counted("patch assemblies"), 1u);
          EXPECT_EQ(problem.ledger.counted("indefinite patches"), 0u);
          const unsigned int first = problem.ledger.counted("stored tangents");
          problem.linearise();
          EXPECT_TRUE(problem.solve("p multigrid", "automatic", 1e-3).first.converged);
          EXPECT_EQ(problem.ledger.counted("stored tangents") - first, n_points == 3 ? 1u : 2u) << "once at each quadrature";
          EXPECT_EQ(problem.ledger.counted("lean tangent actions") > 0, n_points == 5);
        }
    }

    TEST(AutomaticPreconditioner, GoesOverToFactorsWhereTheyAreCheaper)
    {
      const auto solve = [](const Muscle3dParameters &p, const MultigridCase &c, const double tolerance, const unsigned int changes) {
        Problem          problem(p, c);
        testing::Solvers solvers({}, {}, {"type=automatic", "direct up to=0"});
        Vector           x(problem.b);
        for (unsigned int i = 0; i < 4; ++i)
          {
            const LinearReport report = solvers.linear.solve(*problem.linearisation, stage_weights(1, 40, 1600),
                                                             problem.system.constraints(), problem.symmetric, problem.b, x, tolerance);
            EXPECT_TRUE(report.converged) << report.reason;
          }
        EXPECT_EQ(solvers.ledger.counted("changes to direct solves"), changes);
        Vector expected = problem.solve("direct", "assembled", 1e-10).second;
        expected -= x;
        EXPECT_LT(expected.l2_norm(), 1e3 * tolerance * x.l2_norm());
      };
      MultigridCase      c{2, 3, 1, 0, 1e7, false, true, 0};
      Muscle3dParameters sheet = Problem::parameters(c);
      sheet.geometry.size      = {{0.016, 0.016, 0.0004}};
      sheet.geometry.cells     = {{8, 8, 1}};
      solve(sheet, c, 1e-6, 1);
      c.refinement   = 2;
      c.bulk_modulus = 1e6;
      solve(Problem::parameters(c), c, 1e-2, 0);
    }

    TEST(PMultigridSolver, IsReproducible)
    {
      Vector first;
      for (const int run : {0, 1})
        {
          Problem      problem({2, 4, 1, 1, 1e7, true, true, 0});
          const Vector x = problem.solve("p multigrid", "automatic", 1e-6).second;
          if (run == 0)
            first = x;
          else
            EXPECT_TRUE(std::equal(x.begin(), x.end(), first.begin()));
        }
    }
  } // namespace
} // namespace myolines
