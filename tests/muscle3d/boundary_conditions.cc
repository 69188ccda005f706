// SPDX-License-Identifier: LGPL-2.1-or-later
// Boundary conditions in whole runs, against closed forms and against other ways to say the same.
#include "bar.h"

#include <myolines/boundary/tendon_spring.h>
#include <myolines/materials/curves.h>
#include <myolines/system/drive_types.h>

namespace myolines
{
  namespace
  {
    using namespace test;

    Condition pressed(const unsigned int face, const double pressure)
    {
      return condition("follower pressure", face, {set("pressure", pressure)});
    }
    Condition pulled(const double force) { return condition("isotonic", 1, {set("force", force)}); }
    Condition loaded(const double traction) { return condition("directed traction", 1, {set("traction", traction)}); }

    TEST(FollowerPressure, CompressesEvenlyAsInClosedForm)
    {
      Muscle3dParameters p    = bar({condition("symmetry plane", 0)});
      p.muscle().bulk_modulus = 1e6;
      const double pressure   = 2e5; // the edges of dead loads would be wrong by J^(2/3)
      for (const unsigned int face : {1u, 3u, 5u})
        p.boundary.push_back(pressed(face, pressure));
      test::Simulation simulation(p, {"relative tolerance=1e-12"});
      simulation.go("static", 1, 1., [](const State &) {});
      // kappa/2 (J - 1/J) = -pressure
      const double x = pressure / 1e6, J = std::sqrt(x * x + 1) - x, stretch = std::cbrt(J);
      const auto   u = displacement(simulation, corner);
      for (unsigned int c = 0; c < 3; ++c)
        EXPECT_NEAR(u[c], (stretch - 1) * corner[c], 1e-12);
      EXPECT_NEAR(measure_reactions(simulation.system, simulation.state).back().force[0], pressure * 1e-4 * stretch * stretch, 1e-9);
    }

    TEST(FollowerPressure, OnAClosedSurfacePullsNowhere)
    {
      Muscle3dParameters p = test::small_block(2, 3, 1);
      p.activation         = nullptr;
      for (unsigned int face = 0; face < 6; ++face)
        p.boundary.push_back(pressed(face, 1e4));
      WorkLedger     ledger;
      Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      system.move_mesh(test::distort);
      State state = system.initial_state(0);
      test::randomise(state.u, 2e-4, 1);
      Vector3 sum, moment;
      Vector  r(state.u), s(state.u);
      ASSERT_TRUE(system.residual({0, Side::left, state.u, state.v, state.a}, r).admissible);
      const auto &space = *system.discretisation().space;
      double      size  = 0;
      for (const auto node : space.nodes().locally_owned_dofs())
        {
          const Vector3 f({r(3 * node), r(3 * node + 1), r(3 * node + 2)}),
              u({state.u(3 * node), state.u(3 * node + 1), state.u(3 * node + 2)});
          sum += f;
          moment += cross_product_3d(space.node_position(node) + u, f);
          size += f.norm();
        }
      size = dealii::Utilities::MPI::sum(size, MPI_COMM_WORLD);
      EXPECT_LT(dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD).norm(), 1e-12 * size);
      EXPECT_LT(dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD).norm(), 1e-12 * size * 0.03);
    }

    TEST(Foundation, GivesWayByLoadOverStiffness)
    {
      test::Simulation simulation(bar({condition("elastic foundation", 0, {"normal stiffness=2e7", "stiffness=1e7"}), loaded(1e4)}));
      simulation.go("static", 1, 1., [](const State &) {});
      // The bar thins on springs that hold it across: only their mean along x is known, from the balance of forces.
      const auto reactions = measure_reactions(simulation.system, simulation.state);
      EXPECT_NEAR(reactions[2].force[0], -1e4 * 1e-4, 1e-10);
      EXPECT_EQ(reactions[2].power, 0);

      test::Simulation sliding(bar({condition("elastic foundation", 0, {"normal stiffness=2e7"}), loaded(1e4)}));
      sliding.go("static", 1, 1., [](const State &) {});
      for (const dealii::Point<3> x : {dealii::Point<3>(0, 0, 0), dealii::Point<3>(0, 0.01, 0.003)})
        EXPECT_NEAR(displacement(sliding, x)[0], 1e4 / 2e7, 1e-13);
      const BodyMeasures m = measure_body(sliding.system, sliding.state, SlabRule::quadrature_points);
      EXPECT_NEAR(m.stored_springs, 1e-4 * 1e4 * 1e4 / (2 * 2e7), 1e-14);
    }

    TEST(Isotonic, StretchesABarLikeTheSameTraction)
    {
      test::Simulation force(bar({held(0, "x"), pulled(3)})), traction(bar({held(0, "x"), loaded(3e4)}));
      force.go("static", 1, 1., [](const State &) {});
      traction.go("static", 1, 1., [](const State &) {});
      EXPECT_GT(displacement(force, corner)[0], 1e-3);
      EXPECT_LT((displacement(force, corner) - displacement(traction, corner)).norm(), 1e-12);
      const auto reactions = measure_reactions(force.system, force.state);
      EXPECT_NEAR(reactions[2].force[0], -3, 1e-9);
      EXPECT_NEAR(reactions[3].force[0], 3, 1e-9);
    }

    /// An active pennate block that shortens against a load: the face stays plane, and both ends pull with the load.
    TEST(Isotonic, FaceOfAnActiveBlockStaysPlane)
    {
      for (const bool across : {false, true})
        {
          Muscle3dParameters p = test::small_block(2, 3, 1);
          p.dynamic            = false;
          p.boundary           = {held(0), condition("isotonic", 1, {"force=2", std::string("across=") + (across ? "held" : "free")})};
          test::Simulation simulation(p);
          simulation.go("static", 1, 1., [](const State &) {});
          const Vector3 u = displacement(simulation, corner), v = displacement(simulation, dealii::Point<3>(0.03, 0.004, 0.001));
          EXPECT_LT(u[0], -1e-4);
          EXPECT_NEAR(u[0], v[0], 1e-15);
          EXPECT_EQ(std::abs(u[1]) + std::abs(u[2]) == 0, across);
          const auto reactions = measure_reactions(simulation.system, simulation.state);
          EXPECT_NEAR(reactions[0].force[0], -2, 1e-8);
          EXPECT_NEAR(reactions[1].force[0], 2, 1e-8);
          EXPECT_NEAR((reactions[0].force + reactions[1].force).norm(), 0, 1e-8);
        }
    }

    TEST(TendonSpring, IsInEquilibriumWithTheBar)
    {
      const Condition tendon =
          condition("tendon spring", 1, {"spring/type=linear", "spring/stiffness=1500", "motion/type=constant", "motion/value=0.004"});
      test::Simulation simulation(bar({held(0, "x"), tendon}));
      simulation.go("static", 1, 1., [](const State &) {});
      const double q = displacement(simulation, corner)[0], F = 1500 * (0.004 - q);
      EXPECT_GT(q, 1e-3);
      EXPECT_NEAR(measure_reactions(simulation.system, simulation.state)[3].force[0], F, 1e-9);
      EXPECT_NEAR(measure_body(simulation.system, simulation.state, SlabRule::quadrature_points).stored_springs, F * F / 3000, 1e-12);
      test::Simulation weighted(bar({held(0, "x"), pulled(F)}));
      weighted.go("static", 1, 1., [](const State &) {});
      EXPECT_NEAR(displacement(weighted, corner)[0], q, 1e-11);
    }

    TEST(TendonSpring, LawsAreConsistent)
    {
      const auto tendon = make_tendinous_spring(40, 0.1), hill = make_hill_spring(40, 0.1);
      EXPECT_DOUBLE_EQ(tendon->force(0), 0.4);
      EXPECT_DOUBLE_EQ(tendon->force(0.012), 40 * curves::tendon(1.12).value);
      for (const TendonSpring *law : {tendon.get(), hill.get()})
        {
          EXPECT_EQ(law->energy(0), 0);
          for (const double s : {-0.01, 0.0005, 0.0007, 0.0015, 0.004, 0.01, 0.02})
            {
              const double h = 1e-7;
              EXPECT_NEAR((law->energy(s + h) - law->energy(s - h)) / (2 * h), law->force(s), 1e-6 * (1 + law->force(s)));
              EXPECT_NEAR((law->force(s + h) - law->force(s - h)) / (2 * h), law->slope(s), 1e-6 * (1 + law->slope(s)));
            }
        }
    }

    /// Strain of the tendon and its force over F_0 in the muscle-tendon unit, rows of tests/data/muscle_tendon_units.csv, an independent
    /// program.
    TEST(TendonSpring, HillsLawIsThatOfTheMuscleTendonUnit)
    {
      const double                    force = 1870, length = 0.123;
      const auto                      hill   = make_hill_spring(force, length);
      const std::pair<double, double> rows[] = {{-0.004477207, 0.009673495}, {0.010064101, 0.062529079}, {0.013552733, 0.113275842},
                                                {0.019025027, 0.207205710},  {0.022459579, 0.270687817}, {0.033727983, 0.490746101}};
      for (const auto &[strain, expected] : rows)
        EXPECT_NEAR(hill->force(strain * length), expected * force, 2e-8 * force);
    }

    dealii::Tensor<2, 3> rotation()
    {
      const Vector3        axis({1. / 3, 2. / 3, -2. / 3});
      dealii::Tensor<2, 3> R;
      for (unsigned int c = 0; c < 3; ++c)
        {
          Vector3 e;
          e[c]            = 1;
          const Vector3 r = std::cos(0.8) * e + std::sin(0.8) * cross_product_3d(axis, e) + (1 - std::cos(0.8)) * (axis * e) * axis;
          for (unsigned int a = 0; a < 3; ++a)
            R[a][c] = r[a];
        }
      return R;
    }

    std::array<double, 3> turned(const dealii::Tensor<2, 3> &R, const std::array<double, 3> &v)
    {
      const Vector3 r = R * Vector3({v[0], v[1], v[2]});
      return {{r[0], r[1], r[2]}};
    }

    std::string direction(const std::array<double, 3> &v)
    {
      return set("direction", v[0]) + set(" ", v[1]).replace(1, 1, "") + set(" ", v[2]).replace(1, 1, "");
    }

    /// An active block on three symmetry planes under an isotonic load and a foundation, turned in space.
    Vector3 pulled_block(const dealii::Tensor<2, 3> &R)
    {
      Muscle3dParameters p       = test::small_block(2, 3, 1);
      p.dynamic                  = false;
      p.muscle().fibre.direction = turned(R, {{std::cos(0.4), 0, std::sin(0.4)}});
      const Condition pull       = condition("isotonic", 1, {"force=1.5", direction(turned(R, {{1, 0, 0}}))});
      const Condition ground     = condition("elastic foundation", 5, {"normal stiffness=1e6"});
      p.boundary = {condition("symmetry plane", 0), condition("symmetry plane", 2), pull, condition("symmetry plane", 4), ground};
      test::Simulation simulation(p);
      simulation.system.move_mesh([&](const dealii::Point<3> &x) { return dealii::Point<3>(R * x); });
      simulation.state = simulation.system.initial_state(0);
      simulation.go("static", 1, 1., [](const State &) {});
      const auto reactions = measure_reactions(simulation.system, simulation.state);
      EXPECT_NEAR((reactions[0].force + reactions[2].force + reactions[1].force + reactions[3].force + reactions[4].force).norm(), 0, 1e-8);
      return transpose(R) * displacement(simulation, dealii::Point<3>(R * dealii::Point<3>(0.03, 0.004, 0.007)));
    }

    TEST(SymmetryPlane, ATurnedBlockDoesAsTheStraightOne)
    {
      const Vector3 straight = pulled_block(dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>())), turned = pulled_block(rotation());
      EXPECT_GT(straight.norm(), 5e-4);
      EXPECT_LT((straight - turned).norm(), 1e-9 * straight.norm());
    }

    /// Half of a block behind an oblique plane does as the whole one.
    TEST(SymmetryPlane, HalfOfABodyDoesAsTheWhole)
    {
      const dealii::Tensor<2, 3> R   = rotation();
      const auto                 run = [&](const bool half) {
        Muscle3dParameters p       = test::small_block(2, 3, 0);
        p.geometry.size            = {{0.02, half ? 0.01 : 0.02, 0.01}};
        p.geometry.cells           = {{2, half ? 1u : 2u, 1}};
        p.dynamic                  = false;
        p.muscle().fibre.direction = turned(R, {{std::cos(0.4), 0, std::sin(0.4)}});
        p.boundary                 = {held(0), pressed(5, 5e3)};
        if (half)
          p.boundary.push_back(condition("symmetry plane", 3)); // y+, the middle of the whole
        test::Simulation simulation(p);
        simulation.system.move_mesh([&](const dealii::Point<3> &x) { return dealii::Point<3>(R * x); });
        simulation.state = simulation.system.initial_state(0);
        simulation.go("static", 2, 1., [](const State &) {});
        return displacement(simulation, dealii::Point<3>(R * dealii::Point<3>(0.02, 0.003, 0.01)));
      };
      const Vector3 whole = run(false), half = run(true);
      EXPECT_GT(whole.norm(), 1e-4);
      EXPECT_LT((whole - half).norm(), 1e-9 * whole.norm());
    }

    /// |drift| of the energy balance of a twitch against everything that stores, pulls and presses.
    std::pair<double, double> drift_of_a_twitch(const unsigned int steps)
    {
      Muscle3dParameters p       = test::small_block(2, 3, 0);
      p.geometry.cells           = {{2, 1, 1}};
      p.muscle().fibre.direction = {{1, 0, 0}};
      p.activation               = std::make_shared<SmoothStep>(0.4, 0., 0.05, 1.);
      const auto rise            = [](const std::string &list, const double height) {
        return std::vector<std::string>{list + "/type=smooth step", set(list + "/amplitude", height), list + "/duration=0.05"};
      };
      std::vector<std::string> tendon = rise("motion", 0.001), press = rise("profile", 1);
      tendon.insert(tendon.end(), {"direction=0.8 0 0.6", "spring/type=linear", "spring/stiffness=2000"});
      press.push_back("pressure=2e3");
      p.boundary = {condition("tendon spring", 1, tendon), condition("elastic foundation", 0, {"stiffness=3e6"}),
                    condition("follower pressure", 3, press), condition("symmetry plane", 2)};
      test::Simulation run(p);
      double           supplied = 0, rate = 0, t = 0, first = 0, energy = 0, largest = 0;
      bool             started = false;
      run.go("backward euler", steps, 0.05, [&](const State &state) {
        const BodyMeasures m     = measure_body(run.system, state, SlabRule::quadrature_points);
        double             power = m.active_power - m.dissipation + m.traction_power;
        for (const Reaction &reaction : measure_reactions(run.system, state))
          power += reaction.power;
        energy = m.kinetic + m.stored_volumetric + m.stored_base + m.stored_passive + m.stored_springs;
        if (started)
          supplied += (state.t - t) * (power + rate) / 2;
        else
          first = energy;
        started = true;
        rate    = power;
        t       = state.t;
        largest = std::max(largest, energy);
      });
      return {energy - first - supplied, largest};
    }

    TEST(EnergyBalance, ClosesWithSpringsAndFollowerPressures)
    {
      const auto [coarse, scale] = drift_of_a_twitch(80);
      const auto [fine, unused]  = drift_of_a_twitch(160);
      (void) unused;
      EXPECT_LT(std::abs(fine), 0.05 * scale);
      EXPECT_NEAR(coarse / fine, 2., 0.3) << coarse << " " << fine << " of " << scale;
    }

    /// A free body under an isotonic force accelerates as F / m at its centre, whatever the kind of step, and its relations hold for every
    /// rate.
    TEST(Isotonic, AcceleratesAFreeBody)
    {
      Muscle3dParameters p = test::small_block(2, 3, 0);
      p.activation         = nullptr;
      p.boundary           = {condition("isotonic", 1, {"force=0.01", "direction=0.6 0 0.8"})};
      for (const IntegratorEntry &entry : integrator_registry())
        {
          if (!entry.facts.dynamic || !entry.make)
            continue;
          const std::string &method = entry.facts.name;
          const double       end    = 4e-5; // short enough for explicit methods
          test::Simulation   simulation(p);
          Vector             momentum(simulation.state.u), ones(simulation.state.u);
          const auto integrator = entry.make(myolines::testing::node(entry.schema), {simulation.system, simulation.solvers.nonlinear,
                                                                                     BoundaryRates::exact, simulation.solvers.ledger});
          for (int step = 0; step < 8; ++step)
            {
              if (step % 4 == 0)
                integrator->start(simulation.state); // the second time from accelerations
              const StepReport report = integrator->step(end / 8, simulation.state);
              ASSERT_TRUE(report.accepted()) << method << ": " << report.reason;
            }
          const auto linearisation = simulation.system.make_linearisation();
          simulation.system.linearise({0, Side::left, simulation.state.u, simulation.state.v, simulation.state.a}, *linearisation);
          linearisation->apply(stage_weights(0, 0, 1), simulation.state.v, momentum);
          for (const auto i : ones.locally_owned_elements())
            ones(i) = i % 3 == 0 ? 0.6 : i % 3 == 1 ? 0. : 0.8;
          EXPECT_NEAR(momentum * ones, 0.01 * end, 1e-6 * 0.01 * end) << method;
          for (const Vector *x : {&simulation.state.u, &simulation.state.v, &simulation.state.a})
            {
              State relaxed = simulation.state;
              relaxed.u     = *x;
              simulation.system.prescribed(0, Side::left, relaxed);
              relaxed.u -= *x;
              EXPECT_LT(relaxed.u.linfty_norm(), 1e-11 * x->linfty_norm()) << method;
            }
        }
    }
  } // namespace
} // namespace myolines
