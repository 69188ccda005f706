// SPDX-License-Identifier: LGPL-2.1-or-later
// Lines of action, and fascicles whose lengths and curvatures have closed forms.
#include "fixtures.h"

#include <myolines/boundary/line_of_action.h>
#include <myolines/measures/fascicles.h>

#include <gtest/gtest.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    const double pi = dealii::numbers::PI;

    /// 3 x 1 x 1 cm.
    Muscle3dParameters slab_of_muscle()
    {
      Muscle3dParameters p;
      p.geometry.size       = {{0.03, 0.01, 0.01}};
      p.geometry.cells      = {{8, 2, 2}};
      p.geometry.refinement = 0;
      p.n_points            = 3;
      return p;
    }

    /// u = A X, v = B X.
    State affine(const Muscle3dSystem &system, const dealii::Tensor<2, 3> &A, const dealii::Tensor<2, 3> &B)
    {
      State       state = system.initial_state(0);
      const auto &space = *system.discretisation().space;
      for (Vector *x : {&state.u, &state.v})
        x->zero_out_ghost_values();
      for (const auto node : space.nodes().locally_owned_dofs())
        {
          const dealii::Tensor<1, 3> u = A * space.node_position(node), v = B * space.node_position(node);
          for (unsigned int c = 0; c < 3; ++c)
            {
              state.u(3 * node + c) = u[c];
              state.v(3 * node + c) = v[c];
            }
        }
      for (Vector *x : {&state.u, &state.v})
        x->update_ghost_values();
      return state;
    }

    TEST(FasciclesOfABlock, AreStraightAndGoFromBottomToTop)
    {
      Muscle3dParameters p       = slab_of_muscle();
      p.muscle().fibre.direction = {{-std::cos(pi / 6), 0, -std::sin(pi / 6)}}; // of either sense
      WorkLedger           ledger;
      const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      const Fascicles      fascicles(system, 10);
      ASSERT_EQ(fascicles.size(), 8u); // two of eight layers of four cells
      EXPECT_EQ(fascicles.ends(), (std::array<std::size_t, 3>{{16, 0, 0}}));
      for (const double length : fascicles.rest_lengths())
        EXPECT_NEAR(length, 0.02, 1e-11);

      dealii::Tensor<2, 3> A, B;
      A[0][0] = 0.1;
      A[2][2] = -0.05;
      A[0][2] = 0.2;
      B[0][0] = 0.7;
      B[2][2] = 0.3;
      const dealii::Tensor<1, 3> a0({std::cos(pi / 6), 0, std::sin(pi / 6)}), a = a0 + A * a0;
      for (const Fascicles::Shape &shape : fascicles.shapes(affine(system, A, B)))
        {
          EXPECT_NEAR(shape.length, 0.02 * a.norm(), 1e-11);
          EXPECT_NEAR(shape.rate, 0.02 * (B * a0) * a / a.norm(), 1e-10);
          EXPECT_NEAR(shape.curvature, 0, 1e-6);
          EXPECT_NEAR(shape.angle, std::atan2(a[2], a[0]) * 180 / pi, 1e-9);
        }
      EXPECT_NEAR(ReferenceFibre(system).length(), 0.02, 1e-15);
    }

    TEST(FasciclesOfABlock, FollowCircles)
    {
      Muscle3dParameters p = slab_of_muscle();
      p.fields.direction   = {{"z+0.03", "0", "0.015-x"}}; // about (0.015, ., -0.03)
      WorkLedger           ledger;
      const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      const Fascicles      fascicles(system, 100);
      const auto           shapes = fascicles.shapes(system.initial_state(0));
      ASSERT_GT(fascicles.size(), 0u);
      double mean = 0;
      for (std::size_t i = 0; i < fascicles.size(); ++i)
        {
          const dealii::Point<3> start = fascicles.line(i).front();
          const double           R     = std::hypot(start[0] - 0.015, start[2] + 0.03);
          const double           half  = std::min(std::asin(0.015 / R), std::acos(0.03 / R)); // ends at the sides, or at the bottom
          EXPECT_NEAR(shapes[i].length, 2 * half * R, 1e-3 * shapes[i].length) << "radius " << R;
          EXPECT_NEAR(shapes[i].curvature * R, 1, 0.02) << "radius " << R;
          mean += shapes[i].length / static_cast<double>(fascicles.size());
        }
      EXPECT_NEAR(ReferenceFibre(system).length(), mean, 1e-12);
    }

    TEST(FasciclesOfABlock, ThatCloseAreLeftOut)
    {
      Muscle3dParameters p = slab_of_muscle();
      p.fields.direction   = {{"z-0.005", "0", "0.015-x"}}; // about the middle of the block
      WorkLedger           ledger;
      const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      const Fascicles      fascicles(system, 100);
      EXPECT_GT(fascicles.ends()[2], 0u);
      for (const double length : fascicles.rest_lengths())
        EXPECT_LT(length, 0.3);
    }

    TEST(Fascicles, OfAPennateMuscleEndAtItsAponeuroses)
    {
      Muscle3dParameters p;
      p.geometry.gastrocnemius   = Gastrocnemius();
      const Gastrocnemius &g     = *p.geometry.gastrocnemius;
      p.geometry.size            = {{g.muscle_length, g.width, 0.06}};
      p.geometry.cells           = {{4, 4, 2}};
      p.geometry.refinement      = 0;
      p.n_points                 = 3;
      p.muscle().fibre.direction = g.fibre_direction();
      p.tissues[aponeurosis_id]  = tissue_kinds()[aponeurosis_id - 1].defaults;
      WorkLedger           ledger;
      const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      const Fascicles      fascicles(system, 100);
      ASSERT_GT(fascicles.size(), 0u);
      EXPECT_EQ(fascicles.ends(), (std::array<std::size_t, 3>{{0, 2 * fascicles.size(), 0}}));
      for (const double length : fascicles.rest_lengths())
        EXPECT_NEAR(length, g.fibre_length(), 1e-10);
    }

    TEST(LineOfAction, OfABlockIsX)
    {
      const LineChoice choice = find_line_of_action({}, slab_of_muscle().geometry, {});
      ASSERT_TRUE(choice.line);
      EXPECT_EQ(choice.line->direction, (dealii::Tensor<1, 3>({1, 0, 0})));
      EXPECT_EQ(choice.line->begin, 0);
      EXPECT_EQ(choice.line->length, 0.03);
      EXPECT_TRUE(choice.line->in_slab({0.015, 1, -1}, 0));
      EXPECT_FALSE(choice.line->in_slab({0.01, 0, 0}, 0));
      EXPECT_NEAR(choice.line->angle_to(dealii::Tensor<1, 3>({-1, 0, 1})), 45, 1e-13);
    }

    TEST(LineOfAction, IsTheOneThatIsGiven)
    {
      LineGiven given;
      given.faces             = LineGiven::Faces{4, 1}; // from the middle of the bottom to that of x+
      given.thickness         = dealii::Tensor<1, 3>({0, 1, 0});
      const LineChoice choice = find_line_of_action(given, slab_of_muscle().geometry, {});
      ASSERT_TRUE(choice.line);
      const dealii::Tensor<1, 3> expected({0.015 / std::hypot(0.015, 0.005), 0, 0.005 / std::hypot(0.015, 0.005)});
      EXPECT_NEAR((choice.line->direction - expected).norm(), 0, 1e-15);
      EXPECT_NEAR(choice.line->length, (0.03 * 0.015 + 0.01 * 0.005) / std::hypot(0.015, 0.005), 1e-15);
      EXPECT_EQ(*choice.line->thickness, (dealii::Tensor<1, 3>({0, 1, 0})));

      given.thickness = expected;
      EXPECT_NE(find_line_of_action(given, slab_of_muscle().geometry, {}).why_none, "");
    }
  } // namespace
} // namespace myolines
