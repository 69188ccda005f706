// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/nested_dissection.h>

#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    FactorisationCost cost(const std::array<unsigned int, 3> &cells, const unsigned int refinement = 0, const bool turned = false)
    {
      NodeSpace::Mesh mesh(MPI_COMM_WORLD);
      make_block(mesh, {{1. * cells[0], 1. * cells[1], 1. * cells[2]}}, cells, refinement);
      if (turned)
        dealii::GridTools::transform(
            [](const dealii::Point<3> &x) {
              return dealii::Point<3>(0.36 * x[0] - 0.8 * x[1] + 0.48 * x[2], 0.48 * x[0] + 0.6 * x[1] + 0.64 * x[2],
                                      -0.8 * x[0] + 0.6 * x[2]);
            },
            mesh);
      return nested_dissection(NodeSpace(mesh, 2));
    }

    double growth(const FactorisationCost &small, const FactorisationCost &large) { return std::log2(large.cubes / small.cubes); }

    // n unknowns of a rod, a sheet and a cube cost n, n^(3/2) and n^2 (George; Lipton, Rose and Tarjan, doi:10.1137/0716027).
    TEST(NestedDissection, CostsWhatTheShapeAllows)
    {
      EXPECT_NEAR(growth(cost({{64, 1, 1}}), cost({{128, 1, 1}})), 1, 0.05);
      EXPECT_NEAR(growth(cost({{16, 16, 1}}), cost({{32, 32, 1}})), 3, 0.4); // four times the unknowns
      EXPECT_NEAR(growth(cost({{8, 8, 8}}), cost({{16, 16, 16}})), 6, 0.6);  // eight times
    }

    TEST(NestedDissection, CountsTheFrontsOfTwoCells)
    {
      // Degree 2: 9 nodes between them, 2 x 2 x 3 less the face, 1 x 1 x 1 inner node in each as nothing lies between others
      const FactorisationCost two = cost({{2, 1, 1}});
      EXPECT_EQ(two.squares, 27. * 27 + 2 * 3. * 3);
      EXPECT_EQ(two.cubes, 27. * 27 * 27 + 2 * 3. * 3 * 3);
    }

    TEST(NestedDissection, DoesNotDependOnTheFrameNorMuchOnWhoDividesTheCells)
    {
      const FactorisationCost upright = cost({{12, 4, 4}}), turned = cost({{12, 4, 4}}, 0, true), refined = cost({{3, 1, 1}}, 2);
      EXPECT_NEAR(turned.cubes, upright.cubes, 1e-9 * upright.cubes);
      EXPECT_NEAR(std::cbrt(refined.cubes / upright.cubes), 1, 0.25); // of a front
    }
  } // namespace
} // namespace myolines
