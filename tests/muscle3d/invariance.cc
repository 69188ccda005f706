// SPDX-License-Identifier: LGPL-2.1-or-later
// Rigid motions and homogeneous deformations on a distorted mesh.
#include "fixtures.h"

#include <deal.II/physics/transformations.h>

#include <gtest/gtest.h>

#include <set>

namespace myolines
{
  namespace
  {
    using Matrix = dealii::Tensor<2, 3>;
    using Arrow  = dealii::Tensor<1, 3>;

    class Invariance : public ::testing::TestWithParam<unsigned int>
    {
    protected:
      Invariance()
        : system_(test::small_block(GetParam(), GetParam() + 1), MPI_COMM_WORLD, ledger_)
      {
        system_.move_mesh(test::distort);
      }

      /// u = A X + b, v = B X + c, a = 0.
      State affine(const Matrix &A, const Arrow &b, const Matrix &B, const Arrow &c) const
      {
        State       state = system_.initial_state(0);
        const auto &space = *system_.discretisation().space;
        for (const auto node : space.nodes().locally_owned_dofs())
          {
            const Arrow u = A * space.node_position(node) + b, v = B * space.node_position(node) + c;
            for (unsigned int d = 0; d < 3; ++d)
              {
                state.u(3 * node + d) = u[d];
                state.v(3 * node + d) = v[d];
              }
          }
        return state;
      }

      Vector force(const State &state) const
      {
        Vector r(state.u);
        EXPECT_TRUE(system_.residual({0, Side::left, state.u, state.v, state.a}, r).admissible);
        return r;
      }

      static Matrix rotation()
      {
        Arrow axis({1, 2, -0.5});
        return dealii::Physics::Transformations::Rotations::rotation_matrix_3d(dealii::Point<3>(axis / axis.norm()), 0.8);
      }

      WorkLedger     ledger_;
      Muscle3dSystem system_;
      const Matrix   one_{dealii::unit_symmetric_tensor<3>()};
    };

    TEST_P(Invariance, PassiveBodyAtRestCarriesNoForce)
    {
      Muscle3dParameters passive = test::small_block(GetParam(), GetParam() + 1);
      passive.activation         = nullptr;
      Muscle3dSystem body(passive, MPI_COMM_WORLD, ledger_);
      const State    moved = affine(rotation() - one_, Arrow({0.01, 0.02, -0.03}), Matrix(), Arrow());
      Vector         r(moved.u);
      body.move_mesh(test::distort);
      EXPECT_TRUE(body.residual({0, Side::left, moved.u, moved.v, moved.a}, r).admissible);
      EXPECT_LT(r.linfty_norm(), 1e-11); // N; the bulk stiffness times a cell is 100 N
    }

    TEST_P(Invariance, RigidRotationRotatesForces)
    {
      Matrix A;
      A[0][0] = 0.1, A[1][2] = 0.05, A[2][0] = -0.08;
      const Matrix R      = rotation();
      const Vector r      = force(affine(A, Arrow(), Matrix(), Arrow()));
      const Vector turned = force(affine(R * (one_ + A) - one_, Arrow({0.1, 0, 0}), Matrix(), Arrow()));
      double       worst  = 0;
      for (std::size_t i = 0; i < r.size() / 3; ++i)
        for (unsigned int c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(turned(3 * i + c) - R[c][0] * r(3 * i) - R[c][1] * r(3 * i + 1) - R[c][2] * r(3 * i + 2)));
      EXPECT_LT(worst, 1e-11 * r.l2_norm());
    }

    TEST_P(Invariance, RigidVelocityIsNoStrainRate)
    {
      Matrix A, spin;
      A[0][0] = 0.1, A[1][2] = 0.05, A[2][0] = -0.08;
      spin[0][1] = 30, spin[1][0] = -30, spin[0][2] = 12, spin[2][0] = -12;
      const Vector still   = force(affine(A, Arrow(), Matrix(), Arrow()));
      Vector       turning = force(affine(A, Arrow(), spin * (one_ + A), Arrow({1, 2, 3})));
      turning -= still;
      EXPECT_LT(turning.l2_norm(), 1e-7 * still.l2_norm()); // the printed force-velocity curve jumps by 1.7e-7 at rate 0
    }

    TEST_P(Invariance, PatchTestWithMovingBoundary)
    {
      Matrix A, B;
      A[0][0] = 0.1, A[1][2] = 0.05, A[2][0] = -0.08, A[2][2] = -0.04;
      B[0][0] = -0.4, B[0][1] = 0.3, B[2][2] = 0.2;
      const State           state = affine(A, Arrow(), B, Arrow());
      const Vector          r     = force(state);
      std::set<std::size_t> on_boundary;
      for (unsigned int face = 0; face < 6; ++face)
        for (const auto node : system_.discretisation().space->face_nodes(face))
          on_boundary.insert(node);
      double interior = 0, boundary = 0;
      for (std::size_t i = 0; i < r.size() / 3; ++i)
        for (unsigned int c = 0; c < 3; ++c)
          (on_boundary.count(i) ? boundary : interior) += r(3 * i + c) * r(3 * i + c);
      EXPECT_GT(boundary, 0);
      EXPECT_LT(std::sqrt(interior), 1e-12 * std::sqrt(boundary));
    }

    TEST_P(Invariance, MassIsThatOfTheBody)
    {
      State state = affine(Matrix(), Arrow(), Matrix(), Arrow());
      for (std::size_t i = 0; i < state.a.size() / 3; ++i)
        state.a(3 * i + 1) = 1;
      const auto linearisation = system_.make_linearisation();
      Vector     Ma(state.a);
      system_.linearise({0, Side::left, state.u, state.v, state.a}, *linearisation);
      linearisation->apply(stage_weights(0, 0, 1), state.a, Ma);
      double total = 0, volume = dealii::GridTools::volume(system_.discretisation().mesh);
      for (std::size_t i = 0; i < state.a.size() / 3; ++i)
        total += Ma(3 * i + 1);
      EXPECT_NEAR(total, 1060 * volume, 1e-12 * total);
    }

    INSTANTIATE_TEST_SUITE_P(Degrees, Invariance, ::testing::Values(1u, 2u, 3u));
  } // namespace
} // namespace myolines
