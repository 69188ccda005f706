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
    /// @p step: as the end of a step.
    struct Perturbed
    {
      explicit Perturbed(const Muscle3dSystem &system, const double size, const bool step = false)
        : before(system.initial_state(0))
        , u(before.u)
        , begin(before.u)
        , step(step)
      {
        const NodeSpace &space = *system.discretisation().space;
        for (const auto node : space.nodes().locally_owned_dofs())
          {
            const auto X = space.node_position(node);
            u(3 * node) += size * X[0];
            u(3 * node + 1) -= 0.3 * size * X[1] * (1 + 20 * X[0]);
            begin(3 * node + 1) += 2 * size * X[0] + 0.5 * size * X[1];
            begin(3 * node + 2) -= size * X[2] * (1 - 20 * X[0]);
          }
        u.update_ghost_values();
        begin.update_ghost_values();
        zero = u;
        zero = 0;
        zero.update_ghost_values();
      }
      Point point(const LocalUnknowns *z) const { return {0.05, Side::left, u, zero, zero, z, step ? &begin : nullptr}; }

      State  before;
      Vector u, zero, begin;
      bool   step;
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
      Vector plain(at.u), own(at.u);
      ASSERT_TRUE(system.residual(at.point(nullptr), plain).admissible);
      ASSERT_TRUE(system.residual(at.point(&z), own).admissible);
      const double size = plain.l2_norm();
      own -= plain;
      EXPECT_LE(own.l2_norm(), 1e-13 * size);
      const auto linearisation = system.make_linearisation();
      system.linearise(at.point(&z), *linearisation);
      Vector g = linearisation->local()->make_local(), scale = linearisation->local()->local_scale(false);
      linearisation->local()->local_residual(g);
      g.scale(scale);
      EXPECT_LE(g.l2_norm(), 1e-13 * size);
    }

    /// Degree, and whether forces are those of a step.
    class Tangents : public ::testing::TestWithParam<std::tuple<unsigned int, bool>>
    {
    protected:
      unsigned int degree() const { return std::get<0>(GetParam()); }
      bool         step() const { return std::get<1>(GetParam()); }
    };

    // From (u, z) along du, with the dz that its equation gives: R(u_t, z_t) - R(u, z) is alpha times A du + B^T dz to second order in
    // the step, and the equation of z holds to second order where its residual has been a part alpha less.
    TEST_P(Tangents, TheIteratesMoveAlongTheReducedSystem)
    {
      WorkLedger            ledger;
      const Muscle3dSystem  system(contracting(1e7, 1, degree()), MPI_COMM_WORLD, ledger);
      const Perturbed       at(system, 0.05, step());
      const auto            linearisation = system.make_linearisation();
      const LocalEquations &local         = *linearisation->local();
      Vector                g = local.make_local(), dz = g, row = g;
      LocalUnknowns         z = system.local(at.before.u); // another state's
      for (unsigned int i = 0; i < 6; ++i)                 // until D belongs to p, which it does but in a step
        {
          LocalUnknowns next;
          system.advance(z, dz, at.point(nullptr), 1, next);
          z = next;
        }
      Vector here(at.u), du(at.u), line(at.u);
      ASSERT_TRUE(system.residual(at.point(&z), here).admissible);
      du.zero_out_ghost_values();
      std::mt19937                           generator(3);
      std::uniform_real_distribution<double> uniform(-1, 1);
      for (auto &entry : du)
        entry = 1e-4 * uniform(generator);
      system.linearise(at.point(&z), *linearisation);
      local.local_residual(g);
      EXPECT_GT(g.l2_norm(), 0);
      g *= -1;
      local.eliminate(false)->recover(1, du, g, dz);
      local.apply_with_local(stage_weights(1, 0, 0), LocalEquations::Digits::all, du, dz, line, row);
      row -= g;
      EXPECT_LE(row.l2_norm(), 1e-12 * g.l2_norm());
      dz.update_ghost_values();
      double rest[2], rest_z[2];
      for (const int i : {0, 1})
        {
          const double  alpha = i == 0 ? 1e-2 : 1e-3;
          Perturbed     trial = at;
          LocalUnknowns z_t;
          trial.u.add(alpha, du);
          trial.u.update_ghost_values();
          system.advance(z, dz, trial.point(nullptr), alpha, z_t);
          Vector there(at.u);
          ASSERT_TRUE(system.residual(trial.point(&z_t), there).admissible);
          system.linearise(trial.point(&z_t), *linearisation);
          local.local_residual(row);
          row.add(1 - alpha, g);
          rest_z[i] = row.l2_norm() / alpha;
          there -= here;
          there.add(-alpha, line);
          rest[i] = there.l2_norm() / (alpha * line.l2_norm());
        }
      EXPECT_LT(rest[0], 0.1);
      EXPECT_NEAR(rest[1] / rest[0], 0.1, 0.03);
      EXPECT_NEAR(rest_z[1] / rest_z[0], 0.1, 0.03);
    }

    // Eliminated, the equations of u and p are those of u alone: J = A + B^T C^-1 B, of a body whose cells are no boxes too. In a step the
    // columns of forces are others than B.
    TEST_P(Tangents, EquationsOfPressuresCondenseToTheTangent)
    {
      WorkLedger     ledger;
      Muscle3dSystem system(contracting(1e7, 1, degree()), MPI_COMM_WORLD, ledger);
      system.move_mesh([](dealii::Point<3> X) {
        X[1] += 20 * X[0] * X[0];
        return X;
      });
      const Perturbed      at(system, 0.05, step());
      const LocalUnknowns  z             = system.local(at.before.u);
      const auto           linearisation = system.make_linearisation();
      const WeightsByOrder weights       = stage_weights(0.3, 40, 1e3);
      system.linearise(at.point(&z), *linearisation);
      const LocalEquations                  &local = *linearisation->local();
      std::mt19937                           generator(5);
      std::uniform_real_distribution<double> uniform(-1, 1);
      Vector                                 x(at.u), whole(at.u), kept(at.u), zero_z = local.make_local(), dz = zero_z, rows = zero_z;
      x.zero_out_ghost_values();
      for (auto &entry : x)
        entry = uniform(generator);
      linearisation->apply(weights, x, whole);
      local.eliminate(false)->recover(weights[2].u, x, zero_z, dz);
      local.apply_with_local(weights, LocalEquations::Digits::all, x, dz, kept, rows);
      kept -= whole;
      EXPECT_LE(kept.l2_norm(), 1e-11 * whole.l2_norm());
      Vector moved = zero_z;
      local.apply_with_local(weights, LocalEquations::Digits::single, x, dz, kept, moved);
      kept -= whole;
      EXPECT_LE(kept.l2_norm(), 3e-7 * whole.l2_norm());
      EXPECT_LE(moved.l2_norm(), 1e-11 * whole.l2_norm()) << "rows of pressures have all digits";
      local.apply_with_local(weights, LocalEquations::Digits::all, x, zero_z, kept, moved);
      EXPECT_LE(rows.l2_norm(), 1e-11 * moved.l2_norm());

      // softened: the matrix of preconditioners is A + w.u B^T W B
      const auto softened = local.eliminate(true);
      Vector     stiff(at.u), of_volume(at.u);
      for (const auto &line : system.constraints().get_lines())
        x(line.index) = 0;
      linearisation->softened_sparse(weights).vmult(stiff, x);
      local.apply_with_local(weights, LocalEquations::Digits::all, x, zero_z, kept, moved);
      of_volume = 0;
      softened->condense(moved, of_volume);
      kept += of_volume;
      for (const auto &line : system.constraints().get_lines())
        kept(line.index) = stiff(line.index) = 0;
      kept -= stiff;
      EXPECT_LE(kept.l2_norm(), 1e-11 * stiff.l2_norm());
    }

    INSTANTIATE_TEST_SUITE_P(Of, Degrees, ::testing::Values(1u, 2u, 3u));
    INSTANTIATE_TEST_SUITE_P(Of, Tangents, ::testing::Combine(::testing::Values(1u, 2u, 3u), ::testing::Bool()));

    TEST(MixedNewton, InadmissibleVolumesAreSeen)
    {
      WorkLedger           ledger;
      const Muscle3dSystem system(contracting(1e7), MPI_COMM_WORLD, ledger);
      const Perturbed      at(system, 0), beyond(system, -1.5);
      LocalUnknowns        z_t;
      Vector               still = system.make_linearisation()->local()->make_local();
      system.advance(system.local(at.u), still, beyond.point(nullptr), 1, z_t);
      Vector r(at.u);
      EXPECT_FALSE(system.residual(beyond.point(&z_t), r).admissible);
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
      // Exact directions: from this far away the way of loose ones hangs on rounding.
      test::Simulation simulation(p, {"relative tolerance=1e-10", "forcing minimum=1e-7", "forcing maximum=1e-6"});
      const auto       solve = [&](const double stretch, const unsigned int iterations) {
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
        EXPECT_LE(report.iterations, iterations) << stretch;
        return end.u;
      };
      const Vector right = solve(1, 4);
      // The squeezed body takes a few steps in vain, then the cautious solve brings it home.
      for (const auto &[volume, iterations] : {std::pair{1.2, 8u}, std::pair{0.8, 24u}})
        for (int round_off = 0; round_off < 3; ++round_off)
          {
            const double stretch    = std::cbrt(volume) + 1e-13 * round_off;
            Vector       difference = solve(stretch, iterations);
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
