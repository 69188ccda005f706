// SPDX-License-Identifier: LGPL-2.1-or-later
// Additive splits of the muscle, against closed forms and each other.
#include "../support/taylor.h"
#include "fixtures.h"

#include <myolines/muscle3d/loads.h>
#include <myolines/system/drive_types.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    using test::small_block;
    using testing::residual_at;

    /// u = G x, v = W x at the nodes.
    State homogeneous(const Muscle3dSystem &system, const dealii::Tensor<2, 3> &G, const dealii::Tensor<2, 3> &W = {})
    {
      State       s     = system.initial_state(0);
      const auto &space = *system.discretisation().space;
      for (const auto node : space.nodes().locally_owned_dofs())
        for (unsigned int d = 0; d < 3; ++d)
          {
            s.u(3 * node + d) = (G * space.node_position(node))[d];
            s.v(3 * node + d) = (W * space.node_position(node))[d];
          }
      return s;
    }

    dealii::Tensor<2, 3> gradient(const unsigned int row, const unsigned int column, const double value)
    {
      dealii::Tensor<2, 3> G;
      G[row][column] = value;
      return G;
    }

    /// Compressed, sheared and moving, with noise.
    State some_state(const Muscle3dSystem &system)
    {
      State  s = homogeneous(system, gradient(0, 0, 0.1) + gradient(0, 1, 0.07) + gradient(2, 2, -0.04), gradient(0, 0, -0.3));
      Vector noise(s.u);
      test::randomise(noise, 1e-5, 1);
      s.u += noise;
      test::randomise(s.a, 50, 2);
      return s;
    }

    Muscle3dParameters passive_block()
    {
      Muscle3dParameters p = small_block();
      p.activation         = nullptr;
      return p;
    }

    Muscle3dParameters loaded_block(std::shared_ptr<const Drive> activation)
    {
      Muscle3dParameters p = small_block();
      p.activation         = std::move(activation);
      p.body_force         = std::array<std::string, 3>{{"1e4*x", "2", "0"}};
      p.boundary           = {test::condition("traction", 1, {"traction x=3e4", "traction z=1e3*y"})};
      return p;
    }

    const std::vector<std::string> names = {"linear", "volumetric", "passive", "all but active"};

    class Splits : public ::testing::Test
    {
    protected:
      Muscle3dSystem system(Muscle3dParameters p) { return Muscle3dSystem(std::move(p), MPI_COMM_WORLD, ledger_); }
      WorkLedger     ledger_;
    };

    TEST_F(Splits, AreThoseOfCapabilities)
    {
      const auto whole = system(passive_block());
      ASSERT_EQ(whole.capabilities().splits.size(), names.size());
      for (std::size_t i = 0; i < names.size(); ++i)
        {
          EXPECT_EQ(whole.capabilities().splits[i].name, names[i]);
          EXPECT_EQ(whole.capabilities().splits[i].refused, "");
          ASSERT_NE(whole.implicit_part(names[i]), nullptr);
          EXPECT_EQ(&whole.implicit_part(names[i])->constraints(), &whole.constraints()) << "the discretisation is shared";
        }
      EXPECT_EQ(whole.implicit_part("active"), nullptr);
      Muscle3dParameters quasi_static = passive_block();
      quasi_static.dynamic            = false;
      EXPECT_TRUE(system(quasi_static).capabilities().splits.empty());
    }

    TEST_F(Splits, ThatLeaveTheForceVelocityRelationExplicitAreRefusedWithTheirStep)
    {
      // mu = 2e5 Pa 0.9941 6.090887/(5 1/s); cells of 0.015 x 0.005 x 0.005 m: 60 (1/0.015^2 (1/3 + 1/9) + 2/(9 0.005^2)) along the fibres
      Muscle3dParameters p          = small_block();
      p.muscle().fibre.direction    = {{1, 0, 0}};
      const double       viscosity  = 2e5 * 0.994100 * 6.090887 / 5;
      const double       eigenvalue = 60 * (4. / 9 / (0.015 * 0.015) + 2. / 9 / (0.005 * 0.005)) * viscosity / 1060;
      std::ostringstream limit;
      limit.precision(2);
      limit << "limits the step to about " << 2 / eigenvalue << " s";
      for (const Split &split : system(p).capabilities().splits)
        EXPECT_NE(split.refused.find(limit.str()), std::string::npos) << split.refused << ", not " << limit.str();

      p.muscle().fibre.force_velocity = false;
      for (const Split &split : system(p).capabilities().splits)
        EXPECT_EQ(split.refused, "") << "an explicit active stress alone is no viscosity";
    }

    TEST_F(Splits, TheVolumetricPartIsZeroWhereVolumesStay)
    {
      const auto   whole = system(small_block());
      const auto   part  = whole.implicit_part("volumetric");
      const State  s     = homogeneous(whole, gradient(0, 1, 0.3), gradient(2, 1, 2));
      const double scale = 1e7 * 1e-4; // kappa times an area
      EXPECT_LT(residual_at(*part, s).linfty_norm(), 1e-13 * scale);
      EXPECT_GT(residual_at(whole, s).linfty_norm(), 1e-3 * scale);
    }

    TEST_F(Splits, TheVolumetricPartOfADilationIsItsPressure)
    {
      // F = 1.1 I: P = p J F^(-T) = kappa/2 (J - 1/J) 1.1^2 I, J = 1.1^3, on the face x = L of 1e-4 m^2
      const auto           whole = system(small_block());
      dealii::Tensor<2, 3> G;
      for (unsigned int i = 0; i < 3; ++i)
        G[i][i] = 0.1;
      const Vector r     = residual_at(*whole.implicit_part("volumetric"), homogeneous(whole, G));
      const auto  &space = *whole.discretisation().space;
      double       sum   = 0;
      for (const auto node : space.nodes().locally_owned_dofs())
        if (std::abs(space.node_position(node)[0] - 0.03) < 1e-9)
          sum += r(3 * node);
      const double J = std::pow(1.1, 3);
      EXPECT_NEAR(sum, 0.5e7 * (J - 1 / J) * 1.21 * 1e-4, 1e-10 * sum);
    }

    TEST_F(Splits, WithoutActivationThePassiveStressesAreEverything)
    {
      const auto whole = system(passive_block());
      for (const char *name : {"passive", "all but active"})
        {
          Vector difference = residual_at(whole, some_state(whole));
          difference -= residual_at(*whole.implicit_part(name), some_state(whole));
          EXPECT_EQ(difference.l2_norm(), 0) << name;
        }
    }

    TEST_F(Splits, LoadsAreExplicitButInAllButActive)
    {
      const auto  whole = system(loaded_block(nullptr));
      const State s     = some_state(whole);
      Vector      loads(s.u);
      loads.zero_out_ghost_values();
      loads = 0;
      whole.loads().subtract_external(0, Side::left, loads);
      ASSERT_GT(loads.linfty_norm(), 0.1);
      Vector difference = residual_at(*whole.implicit_part("all but active"), s);
      EXPECT_EQ(difference.l2_norm(), residual_at(whole, s).l2_norm());
      difference -= residual_at(*whole.implicit_part("passive"), s);
      difference -= loads;
      EXPECT_LT(difference.linfty_norm(), 1e-12 * residual_at(whole, s).linfty_norm());
    }

    TEST_F(Splits, WhatIsLeftOfAllButActiveIsProportionalToTheActivation)
    {
      const auto explicit_part = [&](const double activation) {
        const auto  whole = system(loaded_block(std::make_shared<test::ConstantDrive>(activation)));
        const State s     = some_state(whole);
        Vector      f     = residual_at(whole, s);
        f -= residual_at(*whole.implicit_part("all but active"), s);
        return f;
      };
      Vector       difference = explicit_part(0.8);
      const double size       = difference.l2_norm();
      difference.add(-2, explicit_part(0.4));
      EXPECT_LT(difference.l2_norm(), 1e-10 * size);
    }

    TEST_F(Splits, ImplicitPartsHaveTheKinksOfTheWhole)
    {
      const auto drive = std::make_shared<PiecewiseDrive>(PiecewiseDrive::lines({{0.1, 0}, {0.3, 1}}));
      const auto whole = system(loaded_block(drive));
      for (const std::string &name : names)
        EXPECT_EQ(whole.implicit_part(name)->events(0, 1), (std::vector<double>{0.1, 0.3})) << name;
    }

    TEST_F(Splits, ImplicitPartsPassTheTaylorTest)
    {
      const auto whole = system(small_block());
      State      s     = some_state(whole);
      Vector     x(s.u);
      test::randomise(x, 1, 4);
      for (const std::string &name : names)
        EXPECT_LT(testing::taylor_error(*whole.implicit_part(name), s, {1, 80, 6400}, x, 1e-7), 1e-7) << name;
    }

    TEST_F(Splits, TheLinearPartIsThePassiveOneForSmallMotions)
    {
      const auto whole = system(small_block());
      State      s     = some_state(whole);
      s.a              = 0;
      const Vector direction(s.u);
      const auto   error = [&](const double size) {
        s.u = 0;
        s.u.add(size, direction);
        Vector       difference = residual_at(*whole.implicit_part("linear"), s);
        const double of         = difference.l2_norm();
        difference -= residual_at(*whole.implicit_part("passive"), s);
        return difference.l2_norm() / of;
      };
      const double coarse = error(1e-3), fine = error(5e-4);
      EXPECT_LT(coarse, 1e-2);
      EXPECT_NEAR(std::log2(coarse / fine), 1, 0.05);
      EXPECT_TRUE(whole.implicit_part("linear")->capabilities().linear);
    }
  } // namespace
} // namespace myolines
