// SPDX-License-Identifier: LGPL-2.1-or-later
// Newton's method with pressure and dilatation as iterates: the solution is that of the condensed system, the way there does not know
// the bulk modulus.
#include "../support/drives.h"
#include "bar.h"
#include "simulation.h"

#include <myolines/time/start.h>

#include <random>

namespace myolines
{
  namespace
  {
    /// A pennate block that is activated between two held ends.
    Muscle3dParameters contracting(const double bulk, const unsigned int refinement = 1, const unsigned int degree = 2)
    {
      Muscle3dParameters p       = test::small_block(degree, degree + 1, refinement);
      p.muscle().fibre.direction = {{std::sqrt(0.75), 0, 0.5}};
      p.muscle().bulk_modulus    = bulk;
      p.activation = std::make_shared<myolines::testing::SmoothDrive>([](double t) { return 4 * t; }, [](double) { return 4.; },
                                                                      [](double) { return 0.; });
      p.boundary   = test::held_ends();
      return p;
    }

    /// The same displacement at which a system is linearised, with wrong volumes, and the local unknowns of a state before.
    struct Perturbed
    {
      explicit Perturbed(const Muscle3dSystem &system, const double size)
        : before(system.initial_state(0))
        , u(before.u)
      {
        const NodeSpace &space = *system.discretisation().space;
        for (const auto node : space.nodes().locally_owned_dofs())
          {
            const auto X = space.node_position(node);
            u(3 * node) += size * X[0];
            u(3 * node + 1) -= 0.3 * size * X[1] * (1 + 20 * X[0]);
          }
        u.update_ghost_values();
        zero = u;
        zero = 0;
        zero.update_ghost_values();
      }
      Point point(const LocalUnknowns *z, const bool solved) const { return {0.05, Side::left, u, zero, zero, z, nullptr, solved}; }

      State  before;
      Vector u, zero;
    };

    class Degrees : public ::testing::TestWithParam<unsigned int>
    {
    };

    TEST_P(Degrees, AtItsOwnPressureTheResidualIsThePlainOne)
    {
      WorkLedger           ledger;
      const Muscle3dSystem system(contracting(1e7, 1, GetParam()), MPI_COMM_WORLD, ledger);
      const Perturbed      at(system, 0.1);
      const LocalUnknowns  z = system.local(at.u);
      ASSERT_TRUE(z.any());
      Vector plain(at.u), own(at.u), solved(at.u);
      ASSERT_TRUE(system.residual(at.point(nullptr, false), plain).admissible);
      ASSERT_TRUE(system.residual(at.point(&z, false), own).admissible);
      ASSERT_TRUE(system.residual(at.point(&z, true), solved).admissible);
      const double size = plain.l2_norm();
      own -= plain;
      solved -= plain;
      EXPECT_LE(own.l2_norm(), 1e-13 * size);
      EXPECT_LE(solved.l2_norm(), 1e-13 * size);
    }

    // From (u, z) along du: R(u_t, z_t) - R(u, z) is alpha times K du + R(u, z*) - R(u, z), to second order in the step.
    TEST_P(Degrees, TheIteratesMoveAlongTheReducedSystem)
    {
      WorkLedger           ledger;
      const Muscle3dSystem system(contracting(1e7, 1, GetParam()), MPI_COMM_WORLD, ledger);
      const Perturbed      at(system, 0.05);
      const LocalUnknowns  z = system.local(at.before.u); // another state's
      Vector               here(at.u), right(at.u), du(at.u), line(at.u);
      ASSERT_TRUE(system.residual(at.point(&z, false), here).admissible);
      ASSERT_TRUE(system.residual(at.point(&z, true), right).admissible);
      du.zero_out_ghost_values();
      std::mt19937                           generator(3);
      std::uniform_real_distribution<double> uniform(-1, 1);
      for (auto &entry : du)
        entry = 1e-4 * uniform(generator);
      const auto linearisation = system.make_linearisation();
      system.linearise(at.point(&z, false), *linearisation);
      linearisation->apply(stage_weights(1, 0, 0), du, line);
      line += right;
      line -= here;
      double rest[2];
      for (const int i : {0, 1})
        {
          const double  alpha = i == 0 ? 1e-2 : 1e-3;
          Perturbed     trial = at;
          LocalUnknowns z_t;
          trial.u.add(alpha, du);
          trial.u.update_ghost_values();
          system.advance(at.point(&z, false), trial.u, alpha, z_t);
          Vector there(at.u);
          ASSERT_TRUE(system.residual(trial.point(&z_t, false), there).admissible);
          there -= here;
          there.add(-alpha, line);
          rest[i] = there.l2_norm() / (alpha * line.l2_norm());
        }
      EXPECT_LT(rest[0], 0.1);
      EXPECT_NEAR(rest[1] / rest[0], 0.1, 0.03);
    }

    INSTANTIATE_TEST_SUITE_P(Of, Degrees, ::testing::Values(1u, 2u, 3u));

    TEST(MixedNewton, InadmissibleVolumesAreSeen)
    {
      WorkLedger           ledger;
      const Muscle3dSystem system(contracting(1e7), MPI_COMM_WORLD, ledger);
      const Perturbed      at(system, 0), beyond(system, -1.5);
      LocalUnknowns        z_t;
      const LocalUnknowns  z = system.local(at.u);
      system.advance(at.point(&z, false), beyond.u, 1, z_t);
      Vector r(at.u);
      EXPECT_FALSE(system.residual(beyond.point(&z_t, false), r).admissible);
    }

    /// Newton iterations of isometric steps, every one down to 1e-8 N of the condensed residual.
    unsigned int iterations_of(const Muscle3dParameters &p, const std::string &method, const unsigned int steps, State &end)
    {
      test::Simulation simulation(p, {"relative tolerance=1e-16", "absolute tolerance=1e-8"});
      simulation.go(method, steps, 0.2, [](const State &) {});
      EXPECT_EQ(simulation.solvers.ledger.counted("line search cuts"), 0u);
      Vector           r(simulation.state.u);
      const State     &s          = simulation.state;
      const Evaluation evaluation = simulation.system.residual({s.t, Side::left, s.u, s.v, s.a}, r);
      EXPECT_TRUE(evaluation.admissible);
      for (const auto &line : simulation.system.constraints().get_lines())
        r(line.index) = 0;
      EXPECT_LE(r.l2_norm(), 1.1e-8) << method;
      end = simulation.state;
      return simulation.solvers.ledger.counted("newton iterations");
    }

    TEST(MixedNewton, CountsDoNotKnowTheBulkModulus)
    {
      for (const std::string method : {"backward euler", "sdirk2"})
        {
          State              end;
          const unsigned int soft  = iterations_of(contracting(1e6, 2), method, 8, end),
                             stiff = iterations_of(contracting(1e9, 2), method, 8, end);
          EXPECT_NEAR(soft, stiff, 2 * (method == "sdirk2" ? 2 : 1)) << method;
          RecordProperty(method + " at 1e6, 1e9", std::to_string(soft) + ", " + std::to_string(stiff));
        }
    }

    /// Passive, 3 x 1 x 1 cm or longer, held at one end under a body force across [N/m^3].
    Muscle3dParameters cantilever(const double length, const double force)
    {
      Muscle3dParameters p = test::small_block(2, 3, 0);
      p.geometry.size[0]   = length;
      p.geometry.cells     = {{static_cast<unsigned int>(std::lround(length / 0.005)), 1, 1}};
      p.dynamic            = false;
      p.activation         = nullptr;
      p.boundary           = {test::held(0)};
      p.body_force         = std::array<std::string, 3>{{"0", "0", std::to_string(force)}};
      return p;
    }

    // Beam theory for the tip: w L^4 / (8 E I), with what shear adds; muscle at rest has E = 6 c1 of its base.
    TEST(MixedNewton, ABlockBendsUnderItsOwnWeightInOneStep)
    {
      test::Simulation whole(cantilever(0.03, -1e4)), parts(cantilever(0.03, -1e4));
      whole.go("static", 1, 1., [](const State &) {});
      parts.go("static", 4, 1., [](const State &) {});
      EXPECT_LE(whole.solvers.ledger.counted("newton iterations"), 8u);
      Vector difference = whole.state.u;
      difference -= parts.state.u;
      EXPECT_LT(difference.linfty_norm(), 1e-10);
      EXPECT_GT(whole.state.u.linfty_norm(), 4e-4);
    }

    /// Tip of a cantilever under the force f per volume by the theory of slender beams: f A L^4 / (8 E I), I = A h^2 / 12.
    double deflection(const Muscle3dParameters &p, const double force)
    {
      const double E = 6 * p.muscle().base.coefficients()[0], L = p.geometry.size[0], h = p.geometry.size[2];
      return 1.5 * force * std::pow(L, 4) / (E * h * h);
    }

    // A body that turns is stretched to second order, which costs a slender one far more force than bending: residuals rise on good steps.
    TEST(MixedNewton, SlenderBodiesBend)
    {
      constexpr double   force = -10; // by 2 % of the length
      Muscle3dParameters p     = cantilever(0.3, force);
      p.geometry.cells         = {{12, 1, 1}};
      test::Simulation simulation(p);
      simulation.go("static", 1, 1., [](const State &) {});
      EXPECT_LE(simulation.solvers.ledger.counted("newton iterations"), 8u);
      EXPECT_EQ(simulation.solvers.ledger.counted("load steps"), 0u);
      EXPECT_NEAR(simulation.state.u.linfty_norm() / std::abs(deflection(p, force)), 1, 0.01);
    }

    TEST(MixedNewton, StaticRaisesLoadsInPartsWhereOneStepIsTooMuch)
    {
      test::Simulation one(cantilever(0.03, -1e5)), raised(cantilever(0.03, -1e5), {"relative tolerance=1e-10", "maximum iterations=4"});
      one.go("static", 1, 1., [](const State &) {});
      raised.go("static", 1, 1., [](const State &) {});
      EXPECT_EQ(one.solvers.ledger.counted("load steps"), 0u);
      EXPECT_GT(raised.solvers.ledger.counted("load steps"), 1u);
      Vector difference = one.state.u;
      difference -= raised.state.u;
      EXPECT_LT(difference.linfty_norm(), 1e-9);
    }

    TEST(MixedNewton, AFirstGuessOfWrongVolumeIsMended)
    {
      Muscle3dParameters p = cantilever(0.03, -1e4);
      test::Simulation   simulation(p);
      const auto         solve = [&](const double stretch) {
        const IntegratorContext context{simulation.system, simulation.solvers.nonlinear, BoundaryRates::scheme, simulation.solvers.ledger};
        StageSolver             solver(context);
        Stage                   stage;
        stage.t                = 1;
        stage.c                = {1, 0, 0};
        State            end   = simulation.system.initial_state(0);
        Vector           d     = end.u;
        const NodeSpace &space = *simulation.system.discretisation().space;
        for (const auto node : space.nodes().locally_owned_dofs())
          for (unsigned int c = 0; c < 3; ++c)
            d(3 * node + c) = (stretch - 1) * space.node_position(node)[c];
        d.update_ghost_values();
        const NonlinearReport report = solver.solve(stage, end, d);
        EXPECT_TRUE(report.converged) << stretch << ": " << report.reason;
        EXPECT_LE(report.iterations, 12u) << stretch;
        return end.u;
      };
      const Vector right = solve(1);
      for (const double stretch : {std::cbrt(1.2), std::cbrt(0.8)})
        {
          Vector difference = solve(stretch);
          difference -= right;
          EXPECT_LT(difference.linfty_norm(), 1e-10) << stretch;
        }
    }

    class AtRest : public ::testing::TestWithParam<std::string>
    {
    };

    // A muscle that holds a weight from equilibrium: nothing moves, no solve takes a step that fails.
    TEST_P(AtRest, AMuscleHoldsAWeight)
    {
      for (const double dt : {1e-3, 1e-2, 5e-2})
        {
          Muscle3dParameters p = test::small_block(2, 3, 0);
          p.geometry.cells     = {{2, 1, 1}};
          p.activation         = std::make_shared<test::ConstantDrive>(0.35);
          p.boundary           = {test::held(0), test::condition("isotonic", 1, {"force=3"})};
          test::Simulation simulation(p, {});
          start_from_equilibrium({simulation.system, simulation.solvers.nonlinear, BoundaryRates::exact, simulation.solvers.ledger},
                                 simulation.state);
          const Vector rest = simulation.state.u;
          const auto   cuts = simulation.solvers.ledger.counted("line search cuts"); // of the start
          simulation.go(GetParam(), 10, 10 * dt, [&](const State &state) {
            Vector drift = state.u;
            drift -= rest;
            EXPECT_LT(drift.linfty_norm(), 1e-8) << GetParam() << ", " << dt;
          });
          EXPECT_EQ(simulation.solvers.ledger.counted("line search cuts"), cuts);
        }
    }

    INSTANTIATE_TEST_SUITE_P(Methods, AtRest,
                             ::testing::Values("backward euler", "bdf2", "tr-bdf2", "sdirk2", "sdirk3", "newmark", "hht alpha", "wbz alpha",
                                               "generalized alpha", "wilson theta"),
                             [](const auto &info) {
                               std::string name = info.param;
                               for (char &c : name)
                                 c = std::isalnum(c) ? c : '_';
                               return name;
                             });
  } // namespace
} // namespace myolines
