// SPDX-License-Identifier: LGPL-2.1-or-later
// Activation by regions, and from an excitation.
#include "../support/temporary.h"
#include "fixtures.h"

#include <myolines/base/error.h>
#include <myolines/muscle3d/body_measures.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace myolines
{
  namespace
  {
    using test::ConstantDrive;

    State sheared(const Muscle3dSystem &system)
    {
      State state = system.initial_state(0);
      for (const auto node : system.discretisation().space->nodes().locally_owned_dofs())
        {
          const dealii::Point<3> &x = system.discretisation().space->node_position(node);
          state.u(3 * node)         = 0.05 * x[0] + 0.1 * x[2];
          state.v(3 * node)         = -0.4 * x[0];
        }
      return state;
    }

    Vector residual(const Muscle3dSystem &system)
    {
      const State state = sheared(system);
      Vector      r(state.u);
      EXPECT_TRUE(system.residual({0, Side::left, state.u, state.v, state.a}, r).admissible);
      return r;
    }

    /// Regions by formula, later ones on top, beside the same levels as scales of one activation.
    TEST(ActivationRegions, AreScalesOfOneActivation)
    {
      WorkLedger         ledger;
      Muscle3dParameters regions = test::small_block(), scaled = test::small_block();
      regions.activation = std::make_shared<ConstantDrive>(0.5);
      regions.regions = {{"right", std::make_shared<ConstantDrive>(0.2)}, {"top", nullptr}, {"corner", std::make_shared<ConstantDrive>(1)}};
      regions.fields.regions         = {"x-0.011", "z-0.006", "x>0.02 && z>0.006"};
      scaled.activation              = std::make_shared<ConstantDrive>(1);
      scaled.fields.activation_scale = "z>0.006 ? (x>0.02 ? 1 : 0) : (x>0.011 ? 0.2 : 0.5)";
      const Muscle3dSystem by_region(regions, MPI_COMM_WORLD, ledger), by_scale(scaled, MPI_COMM_WORLD, ledger);
      const Vector         expected = residual(by_scale);
      Vector               r        = residual(by_region);
      r -= expected;
      EXPECT_LT(r.l2_norm(), 1e-13 * expected.l2_norm());

      const BodyMeasures a = measure_body(by_region, sheared(by_region), SlabRule::quadrature_points),
                         b = measure_body(by_scale, sheared(by_scale), SlabRule::quadrature_points);
      EXPECT_NEAR(a.dissipation, b.dissipation, 1e-12 * std::abs(b.dissipation));
      EXPECT_NEAR(a.active_power, b.active_power, 1e-12 * std::abs(b.active_power));
      EXPECT_NEAR(a.work_density[muscle_active], b.work_density[muscle_active], 1e-12 * std::abs(b.work_density[muscle_active]));
      EXPECT_NE(b.dissipation, 0);
    }

    TEST(ActivationRegions, AloneMakeABodyActive)
    {
      WorkLedger         ledger;
      Muscle3dParameters p = test::small_block();
      p.activation         = nullptr;
      EXPECT_FALSE(Muscle3dSystem(p, MPI_COMM_WORLD, ledger).capabilities().rates);
      p.regions        = {{"all", std::make_shared<ConstantDrive>(0.7)}};
      p.fields.regions = {"1"};
      const Muscle3dSystem whole(p, MPI_COMM_WORLD, ledger), plain(test::small_block(), MPI_COMM_WORLD, ledger);
      EXPECT_TRUE(whole.capabilities().rates);
      Vector r = residual(whole);
      r -= residual(plain);
      EXPECT_LT(r.l2_norm(), 1e-13 * residual(plain).l2_norm());
    }

    class Scenes : public ::testing::Test
    {
    protected:
      static Muscle3dParameters read(const std::string &lists)
      {
        const auto file = test::temporary("activation.xml");
        std::ofstream(file) << "<ParameterList name=\"scene\">" << lists << "</ParameterList>";
        return read_muscle3d(scene::read_scene(file, muscle3d_schema()));
      }
      static std::string complaint(const std::string &lists)
      {
        try
          {
            read(lists);
          }
        catch (const InputError &error)
          {
            return error.what();
          }
        return "";
      }
      static std::string parameter(const std::string &name, const std::string &type, const std::string &text)
      {
        return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + text + "\"/>";
      }
      static std::string value(const std::string &text) { return parameter("value", "double", text); }
      static std::string where(const std::string &text) { return parameter("where", "string", text); }
      static std::string list(const std::string &name, const std::string &inside)
      {
        return "<ParameterList name=\"" + name + "\">" + inside + "</ParameterList>";
      }
    };

    // A constant excitation u holds a = u / (beta + (1 - beta) u).
    TEST_F(Scenes, ExcitationBecomesActivation)
    {
      const Muscle3dParameters p = read(list("excitation", value("0.5") + parameter("deactivation ratio", "double", "0.25")));
      for (const double t : {0., 0.1, 1.})
        EXPECT_NEAR(p.activation_at(t, Side::left).level[0], 0.5 / 0.625, 1e-12);
    }

    TEST_F(Scenes, RegionsHaveDrivesOfTheirOwn)
    {
      const Muscle3dParameters p =
          read(list("activation", value("0.5")) +
               list("activation regions", list("one", where("x") + list("activation", value("0.25"))) + list("two", where("y")) +
                                              list("three", where("z") + list("excitation", value("1")))));
      const Activation a = p.activation_at(0.1, Side::left);
      ASSERT_EQ(a.n_regions, 4);
      EXPECT_EQ(a.level[0], 0.5);
      EXPECT_EQ(a.level[1], 0.25);
      EXPECT_EQ(a.level[2], 0);
      EXPECT_NEAR(a.level[3], 1, 1e-12);
    }

    TEST_F(Scenes, WhatCannotBeIsRefused)
    {
      const std::string half = value("0.5"), region = list("one", where("x+"));
      EXPECT_NE(complaint(list("activation", half) + list("excitation", half)).find("one of them"), std::string::npos);
      EXPECT_NE(complaint(list("excitation", value("1.5"))).find("excitation in [0, 1]"), std::string::npos);
      EXPECT_NE(complaint(list("activation regions", region)).find("not a formula"), std::string::npos);
      EXPECT_NE(complaint(list("activation regions", list("one", where("t-x")))).find("x, y, z, volume and pi"), std::string::npos);
      EXPECT_EQ(complaint(list("activation", half) + list("activation regions", list("one", where("volume-x") + list("activation", half)))),
                "");
      // One oscillation in twenty seconds, from -0.8 to 1.2.
      const std::string slow = parameter("type", "string", "sine") + parameter("offset", "double", "0.2") +
                               parameter("amplitude", "double", "1") + parameter("frequency", "double", "0.05");
      EXPECT_NE(complaint(list("activation", slow)).find("activation in [0, 1.1]"), std::string::npos);
      std::string many;
      for (int r = 0; r < max_regions; ++r)
        many += list("region " + std::to_string(r), where("x"));
      EXPECT_NE(complaint(list("activation regions", many)).find("at most 15 regions"), std::string::npos);
    }

    TEST(ActivationRegions, WithoutAPointAreRefused)
    {
      WorkLedger ledger;
      for (const char *where : {"x-5", "sqrt(-1-x)"})
        {
          Muscle3dParameters p = test::small_block();
          p.regions            = {{"nowhere", std::make_shared<ConstantDrive>(1)}};
          p.fields.regions     = {where};
          EXPECT_THROW(Muscle3dSystem(p, MPI_COMM_WORLD, ledger), InputError) << where;
        }
    }
  } // namespace
} // namespace myolines
