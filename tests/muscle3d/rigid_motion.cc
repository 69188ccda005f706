// SPDX-License-Identifier: LGPL-2.1-or-later
// Faces that move as rigid bodies: a body that follows, against the exact rotation; force and moment; files.
#include "../support/complaint.h"
#include "../support/temporary.h"
#include "bar.h"

#include <fstream>

namespace myolines
{
  namespace
  {
    using test::condition;
    using test::held;

    constexpr double pi = dealii::numbers::PI;

    /// About @p axis (unit vector) by @p angle [rad], by the components across and along it.
    Vector3 rotated(const Vector3 &x, const Vector3 &axis, const double angle)
    {
      const Vector3 along = (x * axis) * axis, across = x - along;
      return along + std::cos(angle) * across + std::sin(angle) * cross_product_3d(axis, across);
    }

    dealii::Point<3> lean(const dealii::Point<3> &x) { return dealii::Point<3>(rotated(Vector3(x), Vector3({0.6, 0, 0.8}), 0.9)); }

    /// Three translations [mm] and three angles, as a motion capture would write them; a quarter of a turn about z in 0.5 s.
    std::string motion_file(const std::string &angle)
    {
      const std::string file = test::temporary("motion_" + angle + ".csv");
      const double      unit = angle == "rad" ? pi / 180 : 1;
      std::ofstream     csv(file);
      csv.precision(17);
      csv << "time [s];tx [mm];ty [mm];tz [mm];rx [" << angle << "];ry [" << angle << "];rz [" << angle << "]\n";
      for (int i = 0; i <= 20; ++i)
        {
          const double t = i / 40.;
          csv << t << ";" << 8 * t << ";" << -4 * t << ";" << 2 * t << ";" << unit * 20 * t << ";" << -unit * 30 * t << ";"
              << unit * 180 * t << "\n";
        }
      return file;
    }

    std::vector<std::string> from_file(const std::string &file, const std::string &interpolation = "smooth")
    {
      std::vector<std::string> entries{"point=0.001 0.002 -0.003"};
      for (const std::string axis : {"x", "y", "z"})
        for (const auto &[list, column] :
             {std::make_pair("translation " + axis, "t" + axis), std::make_pair("rotation " + axis, "r" + axis)})
          entries.insert(entries.end(), {list + "/type=file", list + "/file=" + file, list + "/column=" + column,
                                         list + "/interpolation=" + interpolation});
      return entries;
    }

    /// Where that motion takes a point at 0.5 s. Rotations about axes that have turned are those about fixed axes, the last one first.
    Vector3 moved(const Vector3 &X)
    {
      const Vector3 p({0.001, 0.002, -0.003}), d({0.004, -0.002, 0.001});
      return p + d +
             rotated(rotated(rotated(X - p, Vector3({0, 0, 1}), pi / 2), Vector3({0, 1, 0}), -15 * pi / 180), Vector3({1, 0, 0}),
                     10 * pi / 180);
    }

    double largest_error(const test::Simulation &run)
    {
      const NodeSpace &space = *run.system.discretisation().space;
      double           error = 0;
      for (const auto node : space.nodes().locally_owned_dofs())
        {
          const Vector3 X(space.node_position(node)), u({run.state.u(3 * node), run.state.u(3 * node + 1), run.state.u(3 * node + 2)});
          error = std::max(error, (X + u - moved(X)).norm());
        }
      return dealii::Utilities::MPI::max(error, MPI_COMM_WORLD);
    }

    Muscle3dParameters passive_body()
    {
      Muscle3dParameters p = test::small_block(2, 3, 0);
      p.geometry.cells     = {{3, 1, 1}};
      p.activation         = nullptr;
      p.dynamic            = false;
      return p;
    }

    TEST(RigidMotion, TakesAFreeBodyAlongAsAWhole)
    {
      for (const std::string angle : {"degree", "rad"})
        {
          Muscle3dParameters p = passive_body();
          p.boundary           = {condition("rigid motion", 0, from_file(motion_file(angle)))};
          test::Simulation run(p);
          run.system.move_mesh(lean);
          run.state = run.system.initial_state(0);
          run.go("static", 10, 0.5, [](const State &) {});
          EXPECT_LT(largest_error(run), 1e-9) << angle;
          const Reaction reaction = measure_reactions(run.system, run.state).front();
          ASSERT_EQ(reaction.own.size(), 3u);
          EXPECT_LT(reaction.force.norm(), 1e-6);
          EXPECT_LT(std::hypot(reaction.own[0], reaction.own[1], reaction.own[2]), 1e-8);
        }
    }

    /// Two faces, one moved, one held by a motion that stands still: forces and moments of both balance, on a bent and twisted body.
    TEST(RigidMotion, TellsForceAndMoment)
    {
      Muscle3dParameters p = passive_body();
      p.boundary           = {condition("rigid motion", 0, {"point=0 0 0", "rotation x/type=constant"}),
                              condition("rigid motion", 1,
                                        {"point=0.03 0.004 0.006", "rotation x/type=ramp", "rotation x/amplitude=20", "rotation x/duration=1",
                                         "rotation z/type=ramp", "rotation z/amplitude=-15", "rotation z/duration=1", "translation x/type=ramp",
                                         "translation x/amplitude=1e-3", "translation x/duration=1"})};
      test::Simulation run(p, {"relative tolerance=1e-12"});
      run.system.move_mesh(lean);
      run.state = run.system.initial_state(0);
      run.go("static", 4, 1, [](const State &) {});
      const auto    reactions = measure_reactions(run.system, run.state);
      const Vector3 held({reactions[0].own[0], reactions[0].own[1], reactions[0].own[2]}),
          turned({reactions[1].own[0], reactions[1].own[1], reactions[1].own[2]}), point({0.031, 0.004, 0.006});
      EXPECT_GT(turned.norm(), 1e-3);
      EXPECT_LT((reactions[0].force + reactions[1].force).norm(), 1e-8 * reactions[1].force.norm());
      EXPECT_LT((held + turned + cross_product_3d(point, reactions[1].force)).norm(), 1e-8 * turned.norm());
    }

    /// Power of a rigid motion: force times velocity of the point, moment times angular velocity.
    TEST(RigidMotion, WorksByForceAndMoment)
    {
      Muscle3dParameters p = passive_body();
      p.dynamic            = true;
      p.boundary           = {
                    condition("rigid motion", 1,
                              {"point=0.03 0.004 0.006", "axis x=0.8 0 0.6", "axis y=0 1 0", "rotation y/type=sine", "rotation y/amplitude=30",
                               "rotation y/frequency=2", "translation z/type=sine", "translation z/amplitude=2e-3", "translation z/frequency=1"})};
      WorkLedger     ledger;
      Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      const double   t     = 0.06;
      State          state = system.still_state();
      state.t              = t;
      test::randomise(state.u, 1e-4, 7);
      system.prescribed(t, Side::left, state);
      const Reaction reaction = measure_reactions(system, state).front();
      const double   omega = 30 * pi / 180 * 4 * pi * std::cos(4 * pi * t), speed = 2e-3 * 2 * pi * std::cos(2 * pi * t);
      const Vector3  axis({-0.6, 0, 0.8}); // z
      EXPECT_NEAR(reaction.power, speed * (reaction.force * axis) + omega * reaction.own[1], 1e-10 * std::abs(reaction.power));
      EXPECT_GT(std::abs(omega * reaction.own[1]), 1e-3 * std::abs(reaction.power));
    }

    TEST(RigidMotion, KnowsTheKinksOfItsFile)
    {
      const std::string  file = motion_file("degree");
      Muscle3dParameters p    = passive_body();
      WorkLedger         ledger;
      p.boundary = {condition("rigid motion", 0, from_file(file, "lines"))};
      EXPECT_EQ(Muscle3dSystem(p, MPI_COMM_WORLD, ledger).events(0.01, 0.49).size(), 19u);
      p.boundary = {condition("rigid motion", 0, from_file(file))};
      EXPECT_TRUE(Muscle3dSystem(p, MPI_COMM_WORLD, ledger).events(0.01, 0.49).empty());
    }

    TEST(RigidMotion, RefusesWhatIsNoMotion)
    {
      const auto complaint = [](const std::vector<std::string> &entries) {
        return test::complaint([&] { condition("rigid motion", 0, entries); });
      };
      EXPECT_NE(complaint({}).find("nothing says how the face moves"), std::string::npos);
      EXPECT_NE(complaint({"rotation x/value=1", "axis x=1 0 0"}).find("is missing"), std::string::npos);
      EXPECT_NE(complaint({"rotation x/value=1", "axis x=1 0 0", "axis y=-2 0 0"}).find("has the direction of"), std::string::npos);
      EXPECT_NE(complaint({"rotation x/value=1", "point=1 0"}).find("three numbers"), std::string::npos);
      EXPECT_NE(complaint({"rotation x/value=1", "order=x x y"}), "");
    }
  } // namespace
} // namespace myolines
