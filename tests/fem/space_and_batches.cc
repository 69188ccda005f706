// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/cell_batches.h>

#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    class Space : public ::testing::TestWithParam<unsigned int>
    {
    protected:
      Space()
        : mesh_(MPI_COMM_WORLD)
      {
        make_block(mesh_, {{3., 1., 2.}}, {{3, 1, 2}}, 1);
      }
      NodeSpace::Mesh mesh_;
    };

    TEST_P(Space, ElementReproducesPolynomialsOfItsDegree)
    {
      const unsigned int k = GetParam();
      const Element      element(k, k + 1);
      const NodeSpace    space(mesh_, k);
      // Nodes of the first cell, along x: the interpolant of x^k is x^k.
      std::vector<dealii::types::global_dof_index> nodes;
      const auto                                   cell = space.nodes().begin_active();
      space.cell_nodes(cell, nodes);
      const double x0 = cell->vertex(0)[0], h = cell->vertex(1)[0] - x0;
      for (int q = 0; q < element.n_points_1d; ++q)
        {
          double value = 0, slope = 0;
          for (int i = 0; i < element.n_nodes_1d; ++i)
            {
              const double f = std::pow(space.node_position(nodes[i])[0], double(k));
              value += element.value[q * element.n_nodes_1d + i] * f;
              slope += element.derivative[q * element.n_nodes_1d + i] * f / h;
            }
          const double x = x0 + h * element.point[q];
          EXPECT_NEAR(value, std::pow(x, double(k)), 1e-13);
          EXPECT_NEAR(slope, k * std::pow(x, k - 1.), 1e-12);
        }
    }

    TEST_P(Space, ModesAreOrthonormal)
    {
      const Element element(GetParam(), GetParam() + 1);
      for (int i = 0; i < element.n_modes; ++i)
        for (int j = 0; j < element.n_modes; ++j)
          {
            double sum = 0;
            for (int q = 0; q < element.n_points; ++q)
              sum += element.weights_3d[q] * element.modes[q * element.n_modes + i] * element.modes[q * element.n_modes + j];
            EXPECT_NEAR(sum, i == j, 1e-13);
          }
    }

    TEST_P(Space, FacesHoldTheNodesThatLieOnThem)
    {
      const NodeSpace space(mesh_, GetParam());
      const double    size[3] = {3, 1, 2};
      for (unsigned int face = 0; face < 6; ++face)
        for (const auto node : space.face_nodes(face))
          EXPECT_NEAR(space.node_position(node)[face / 2], face % 2 ? size[face / 2] : 0., 1e-14);
      EXPECT_EQ(space.face_nodes(1).size(), (2 * GetParam() + 1) * (4 * GetParam() + 1));
    }

    TEST_P(Space, BatchesCoverTheBodyOnce)
    {
      dealii::GridTools::transform(
          [](const dealii::Point<3> &x) {
            return dealii::Point<3>(x[0] + 0.05 * x[1] * x[2], x[1] + 0.1 * x[0], x[2] + 0.02 * x[0] * x[1]);
          },
          mesh_);
      const Element     element(GetParam(), 3);
      const NodeSpace   space(mesh_, GetParam());
      const CellBatches batches(space, element);
      double            volume = 0;
      unsigned int      cells  = 0;
      for (unsigned int b = 0; b < batches.n_owned_batches(); ++b)
        {
          cells += batches.n_filled(b);
          EXPECT_GT(batches.geometry_stride(b), 0u); // no cell of this mesh is a parallelepiped
          for (unsigned int lane = 0; lane < batches.n_filled(b); ++lane)
            for (int q = 0; q < element.n_points; ++q)
              volume += element.weights_3d[q] * batches.geometry(b)[q * batches.geometry_stride(b) + 9 * n_lanes + lane];
        }
      EXPECT_EQ(cells, mesh_.n_active_cells());
      EXPECT_NEAR(volume, dealii::GridTools::volume(mesh_), 1e-12);
    }

    INSTANTIATE_TEST_SUITE_P(Degrees, Space, ::testing::Values(1u, 2u, 3u));
  } // namespace
} // namespace myolines
