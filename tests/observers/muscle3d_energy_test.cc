// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: energies, powers and averages of a block in homogeneous motion are those of their closed forms.

#include "block.h"

#include <tuple>

TEST(MuscleOutputs, EnergyOfAFreeBlockUnderABodyForceIsBalanced)
{
  // A free rigid block under the force f per volume: v = f t / rho, so kinetic energy and work of the force agree, and the
  // trapezoidal rule is exact.
  Muscle3dParameters p = block();
  p.activation         = nullptr;
  p.body_force         = std::array<std::string, 3>{{"3000", "0", "-1000"}};
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  const auto           observers = make_outputs(output_scene(setting("every", "int", "2")), system, folder.path, ledger);
  const auto           at        = [&](const double t) { return homogeneous(system, t, {}, {}, {3000 / 1060. * t, 0, -1000 / 1060. * t}); };
  observers[0]->begin(at(0));
  for (const auto &[number, t] : {std::pair<std::size_t, double>{1, 0.01}, {2, 0.025}, {3, 0.03}, {4, 0.1}})
    observers[0]->accepted(at(t), step(number));

  const std::vector<std::string> lines = folder.lines("energy_balance.csv");
  ASSERT_EQ(lines.size(), 4u); // header, start, steps 2 and 4; step 3 counts in the integral all the same
  const std::vector<double> last = test::numbers(lines[3]);
  const double              work = 0.03 * 0.01 * 0.02 * (3000. * 3000 + 1000. * 1000) / 1060 * 0.1 * 0.1 / 2;
  EXPECT_NEAR(last[1], work, 1e-12 * work);
  EXPECT_NEAR(last[7], work, 1e-12 * work);
  EXPECT_NEAR(last[8], 0, 1e-12 * work);
  for (const unsigned int column : {2, 3, 4, 5, 6})
    EXPECT_NEAR(last[column], 0, 1e-12 * work) << column;
}

/// The first two have no point, and no centre of a cell, in the slab.
TEST(MuscleOutputs, AveragesAreDefinedForEveryMesh)
{
  for (const auto &[cells, points, rule] : {std::tuple<unsigned int, unsigned int, SlabRule>{1, 4, SlabRule::quadrature_points},
                                            {2, 3, SlabRule::whole_cells},
                                            {2, 2, SlabRule::quadrature_points}})
    {
      Muscle3dParameters p = block();
      p.geometry.cells     = {{cells, 1, 1}};
      p.n_points           = points;
      WorkLedger           ledger;
      const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
      const BodyMeasures   rest = measure_body(system, homogeneous(system, 0, {}, {}), rule);
      EXPECT_NEAR(rest.mean_stretch, 1, 1e-14);
      EXPECT_NEAR(rest.mean_pennation, 30, 1e-10);
      EXPECT_GT(rest.slab_volume, 0);
      EXPECT_LE(rest.slab_volume, 0.03 * 0.01 * 0.02 * (1 + 1e-12));

      const BodyMeasures moving = measure_body(system, homogeneous(system, 0, {}, {}, {0.5, 0, 0}), rule);
      EXPECT_NEAR(moving.mean_velocity[0], 0.5, 1e-14);
    }
}

TEST(MuscleOutputs, TheEnergyOfAVelocityThatJumpsIsExternalWork)
{
  Muscle3dParameters p = block();
  p.activation         = nullptr;
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  const auto           observers = make_outputs(output_scene(setting("every", "int", "3")), system, folder.path, ledger);
  const auto           at        = [&](const double t, const double v) { return homogeneous(system, t, {}, {}, {v, 0, 0}); };
  observers[0]->begin(at(0, 1));
  observers[0]->accepted(at(0.1, 1), step(1)); // no row, so that the energy is looked at where the run restarts
  observers[0]->restarting(at(0.1, 1));
  observers[0]->restarted(at(0.1, 3));
  observers[0]->accepted(at(0.2, 3), step(2));
  observers[0]->accepted(at(0.3, 3), step(3));
  const std::vector<double> last    = test::numbers(folder.lines("energy_balance.csv").back());
  const double              kinetic = 0.03 * 0.01 * 0.02 * 1060 / 2;
  EXPECT_NEAR(last[7], (9 - 1) * kinetic, 1e-12);
  EXPECT_NEAR(last[8], 0, 1e-12);
  EXPECT_NEAR(observers[0]->energy_balance()->report().exchanged, kinetic, 1e-12);
}

TEST(MuscleOutputs, PowersAloneAreThoseOfAllMeasures)
{
  Muscle3dParameters p = block();
  p.body_force         = std::array<std::string, 3>{{"3000", "0", "-1000"}};
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  const State          state  = homogeneous(system, 0.1, {0.1, -0.03, -0.02}, {-2, 0.5, 0.25});
  const BodyMeasures   body   = measure_body(system, state, SlabRule::quadrature_points);
  const Powers         powers = measure_powers(system, state);
  EXPECT_NE(powers.active_power, 0);
  EXPECT_DOUBLE_EQ(powers.active_power, body.active_power);
  EXPECT_DOUBLE_EQ(powers.dissipation, body.dissipation);
  EXPECT_DOUBLE_EQ(powers.body_force_power, body.body_force_power);
  EXPECT_NE(powers.body_force_power, 0);
}

TEST(MuscleOutputs, ConditionsTellTheirPowersAndTendons)
{
  // u = (0, 0, 0) + (a X, 0, 0) with v = (r X, 0, 0): the face x = L moves by a L at r L.
  constexpr double   L = 0.03, a = 0.1, r = 2, k = 400, traction = 5e3, foundation = 3e5;
  Muscle3dParameters p = block();
  p.activation         = nullptr;
  p.boundary           = {
                fixed("left", 0), test::condition("tendon spring", 1, {"direction=1 0 0", "spring/type=linear", "spring/stiffness=400"}, "tendon"),
                test::condition("traction", 5, {"traction x=5e3"}, "pull"), test::condition("elastic foundation", 4, {"stiffness=3e5"}, "ground")};
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  const auto           observers = make_outputs(output_scene(setting("conditions", "bool", "true")), system, folder.path, ledger);
  observers[0]->begin(homogeneous(system, 0, {a, 0, 0}, {r, 0, 0}));

  const std::vector<std::string> lines = folder.lines("conditions.csv");
  EXPECT_EQ(lines[0],
            "Time [s],left power [W],tendon power [W],tendon stored [J],tendon dissipation [W],tendon elongation [m],pull power [W],"
            "ground power [W],ground stored [J],ground dissipation [W]");
  const std::vector<double> row = test::numbers(lines[1]);
  EXPECT_NEAR(row[1], 0, 1e-14);
  EXPECT_NEAR(row[3], k / 2 * std::pow(a * L, 2), 1e-15);
  EXPECT_EQ(row[4], 0);
  EXPECT_NEAR(row[5], -a * L, 1e-15);
  const double side = L * 0.01; // the faces z = 0 and z = 2 cm
  EXPECT_NEAR(row[6], traction * side * r * L / 2, 1e-12);
  EXPECT_NEAR(row[7], -foundation * side * a * r * L * L / 3, 1e-12);
  EXPECT_NEAR(row[8], foundation / 2 * side * a * a * L * L / 3, 1e-14);
  EXPECT_EQ(row[9], 0);
}
