// SPDX-License-Identifier: LGPL-2.1-or-later
// Fibres between faces, and the acoustic tensor.
#include "fixtures.h"

#include <myolines/measures/acoustic_tensor.h>
#include <myolines/muscle3d/point_states.h>

#include <deal.II/physics/transformations.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    /// Visits all points: position, fibre direction.
    template <typename Visitor>
    void visit_directions(const Muscle3dSystem &system, const Visitor &visit)
    {
      const State state = system.initial_state(0);
      PointStates(system, state).for_each([&](const NodeSpace::Cell &cell, const int q, const PointState &p) {
        visit(point_position(system.discretisation().element, cell, q), Vector3({p.material[0], p.material[1], p.material[2]}));
      });
    }

    Muscle3dParameters between(const unsigned int from, const unsigned int to, const unsigned int refinement)
    {
      Muscle3dParameters p = test::small_block(2, 3, refinement);
      p.fields.laplace     = FibresBetweenFaces{from, to};
      return p;
    }

    // A linear potential is in the space, whatever the mesh.
    TEST(FibresBetweenFaces, OfABlockAreStraight)
    {
      WorkLedger     ledger;
      Muscle3dSystem system(between(0, 1, 1), MPI_COMM_WORLD, ledger);
      unsigned int   visited = 0;
      visit_directions(system, [&](const dealii::Point<3> &, const Vector3 &a) {
        EXPECT_LT((a - Vector3({1, 0, 0})).norm(), 1e-10);
        ++visited;
      });
      EXPECT_GT(visited, 0u);
    }

    /// The block bent to a quarter of a ring about the y axis.
    dealii::Point<3> bend(const dealii::Point<3> &x, const double length)
    {
      const double r = 0.02 + x[2], angle = x[0] / length * dealii::numbers::PI / 2;
      return dealii::Point<3>(r * std::sin(angle), x[1], r * std::cos(angle));
    }

    // Fibres along the ring are circles: the potential is the angle, whose level sets are edges of cells. Across it they are radii, and the
    // potential, the logarithm of the radius, is no polynomial.
    TEST(FibresBetweenFaces, OfARingAreCirclesAndRadii)
    {
      for (const bool along : {true, false})
        {
          double last = 1;
          for (const unsigned int refinement : {1, 2, 3})
            {
              WorkLedger     ledger;
              Muscle3dSystem system(along ? between(0, 1, refinement) : between(4, 5, refinement), MPI_COMM_WORLD, ledger);
              const double   length = system.parameters().geometry.size[0];
              system.move_mesh([&](const dealii::Point<3> &x) { return bend(x, length); });
              double worst = 0;
              visit_directions(system, [&](const dealii::Point<3> &x, const Vector3 &a) {
                const double r = std::hypot(x[0], x[2]);
                worst          = std::max(worst, (a - (along ? Vector3({x[2], 0, -x[0]}) : Vector3({x[0], 0, x[2]})) / r).norm());
              });
              EXPECT_LT(worst, along ? 1e-10 : 0.6 * last) << refinement;
              last = worst;
            }
          EXPECT_LT(last, 0.1);
        }
    }

    PointState at_rest(const Muscle3dParameters &p, const Matrix3 &F)
    {
      PointState s{};
      s.F           = F;
      s.J           = determinant(F);
      s.dilatation  = s.J;
      s.material    = material(p.muscle());
      s.material_id = muscle_id;
      return s;
    }

    // Isotropic at rest: shear waves with 2 c1, twice, and a pressure wave with kappa + 4/3 of it.
    TEST(AcousticTensor, OfAnIsotropicMaterialAtRestIsItsShearModulus)
    {
      Muscle3dParameters p    = test::small_block();
      p.activation            = nullptr;
      p.muscle().fibre.sigma0 = 0;
      p.muscle().base         = {1, {3e4, 0, 0}};
      EXPECT_NEAR(smallest_acoustic_eigenvalue(p, {}, at_rest(p, Matrix3(dealii::unit_symmetric_tensor<3>()))), 6e4, 1e-6 * 6e4);
    }

    // Along the fibre of a fully active muscle the modulus is the slope of the force-length curve, negative on its descending limb; a shear
    // band needs no change of volume.
    TEST(AcousticTensor, OnTheDescendingLimbLosesEllipticity)
    {
      Muscle3dParameters p       = test::small_block();
      p.dynamic                  = false;
      p.muscle().base            = {1, {100, 0, 0}};
      p.muscle().fibre.direction = {{1, 0, 0}};
      const double  s            = 1.2;
      const Matrix3 F({{s, 0, 0}, {0, 1 / std::sqrt(s), 0}, {0, 0, 1 / std::sqrt(s)}});
      Activation    full, none;
      full.level[0] = 1;
      p.curves      = nullptr;
      EXPECT_LT(smallest_acoustic_eigenvalue(p, full, at_rest(p, F)), 0);
      EXPECT_GT(smallest_acoustic_eigenvalue(p, none, at_rest(p, F)), 0);
    }

    /// Turned with its state a body has the same eigenvalue; sheared states of an active muscle have several minima over the directions.
    TEST(AcousticTensor, DoesNotDependOnTheFrame)
    {
      Muscle3dParameters p = test::small_block();
      p.dynamic            = false;
      p.curves             = nullptr;
      Activation full;
      full.level[0] = 1;
      for (const unsigned int state : {2u, 3u, 4u})
        {
          const auto    part = [state](const unsigned int i) { return 0.35 * std::sin(1 + 2.3 * i + 1.7 * state); };
          const Matrix3 F({{1 + part(0), part(1), part(2)}, {part(3), 1 + part(4), part(5)}, {part(6), part(7), 1 + part(8)}});
          ASSERT_GT(determinant(F), 0.1);
          p.muscle().fibre.direction = {{1, 0, 0}};
          const double lies          = smallest_acoustic_eigenvalue(p, full, at_rest(p, F));
          for (const double angle : {1.1, 2.6})
            {
              const Matrix3 R = dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
                  dealii::Point<3>(dealii::Point<3>(1, 2, -0.5) / dealii::Point<3>(1, 2, -0.5).norm()), angle);
              const Vector3 a            = R * Vector3({1, 0, 0});
              p.muscle().fibre.direction = {{a[0], a[1], a[2]}};
              const double turned        = smallest_acoustic_eigenvalue(p, full, at_rest(p, R * F * transpose(R)));
              EXPECT_NEAR(turned, lies, 1e-4 * (std::abs(lies) + 1e3)) << state << " " << angle;
            }
        }
    }
  } // namespace
} // namespace myolines
