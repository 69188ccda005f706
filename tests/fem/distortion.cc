// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/distortion.h>

#include <gtest/gtest.h>

#include <set>

namespace myolines
{
  namespace
  {
    const std::array<double, 3>       size{{0.3, 0.02, 0.01}};
    const std::array<unsigned int, 3> cells{{3, 1, 2}};
    const unsigned int                refinement = 2;

    /// Vertices before and after, and the smallest determinant at vertices of the map onto a cell, over the volume of a cell of the box.
    struct Distorted
    {
      explicit Distorted(const double amount)
        : mesh(MPI_COMM_SELF)
      {
        NodeSpace::Mesh box(MPI_COMM_SELF);
        make_block(box, size, cells, refinement);
        make_block(mesh, size, cells, refinement);
        distort_block(mesh, size, cells, refinement, amount);
        before = box.get_vertices();
        after  = mesh.get_vertices();
        for (const auto &cell : mesh.active_cell_iterators())
          volume += cell->measure();
        smallest = smallest_determinant();
      }

      double smallest_determinant() const
      {
        double least = 1e300;
        for (const auto &cell : mesh.active_cell_iterators())
          for (unsigned int corner = 0; corner < 8; ++corner)
            {
              std::array<dealii::Tensor<1, 3>, 3> edge;
              for (unsigned int d = 0; d < 3; ++d)
                edge[d] = (cell->vertex(corner | 1u << d) - cell->vertex(corner & ~(1u << d)));
              least = std::min(least, edge[0] * dealii::cross_product_3d(edge[1], edge[2]));
            }
        return least / (size[0] * size[1] * size[2] / mesh.n_active_cells());
      }

      NodeSpace::Mesh               mesh;
      std::vector<dealii::Point<3>> before, after;
      double                        volume = 0, smallest = 0;
    };
    TEST(Distortion, ShiftsVerticesUpToTheGivenPartOfACell)
    {
      const Distorted  box(largest_distortion);
      std::set<double> shifts;
      double           largest = 0;
      for (std::size_t i = 0; i < box.before.size(); ++i)
        for (unsigned int d = 0; d < 3; ++d)
          {
            const double n = cells[d] << refinement, shift = (box.after[i][d] - box.before[i][d]) / (size[d] / n);
            if (std::lround(box.before[i][d] / size[d] * n) % static_cast<long>(n) == 0)
              EXPECT_EQ(shift, 0) << "the box keeps its shape";
            else
              shifts.insert(shift);
            largest = std::max(largest, std::abs(shift));
          }
      EXPECT_LE(largest, largest_distortion + 1e-12);
      EXPECT_GT(largest, 0.95 * largest_distortion);
      EXPECT_GT(shifts.size(), 900u) << "each its own";
    }

    TEST(Distortion, LeavesTheVolumeAndEveryCellPositive)
    {
      const Distorted box(largest_distortion);
      EXPECT_NEAR(box.volume, 0.3 * 0.02 * 0.01, 1e-12 * box.volume);
      EXPECT_GT(box.smallest, 0.15);
      EXPECT_LT(box.smallest, 0.9) << "distorted indeed";
    }
  } // namespace
} // namespace myolines
