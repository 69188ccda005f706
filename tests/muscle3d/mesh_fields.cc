// SPDX-License-Identifier: LGPL-2.1-or-later
// Properties of points from the arrays of a mesh.
#include "../support/complaint.h"
#include "../support/temporary.h"

#include <myolines/body/body_fields.h>
#include <myolines/meshes/write.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace myolines
{
  namespace mesh_fields
  {
    using Shape = PlainMesh::Shape;

    /// A unit cube as a hexahedron, beside it along x a wedge of half a cube.
    PlainMesh cube_and_wedge()
    {
      PlainMesh mesh;
      mesh.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}, {{0, 0, 1}},
                     {{1, 0, 1}}, {{1, 1, 1}}, {{0, 1, 1}}, {{2, 0, 0}}, {{2, 1, 0}}};
      mesh.cells  = {{Shape::hexahedron, 1, {{0, 1, 2, 3, 4, 5, 6, 7}}}, {Shape::wedge, 1, {{1, 5, 8, 2, 6, 9}}}};
      return mesh;
    }

    std::filesystem::path file_of(const PlainMesh &mesh)
    {
      const auto file = test::temporary("fields.vtu");
      std::ofstream(file) << mesh_text(mesh, ".vtu");
      return file;
    }

    const std::vector<dealii::Point<3>> places{{0.1, 0.2, 0.3}, {0.9, 0.4, 0.7}, {1.2, 0.5, 0.1}, {1, 0.5, 0.5}, {1.4, 1, 0.6}, {0, 0, 0}};

    TEST(MeshFields, OfPointsAreLinear)
    {
      PlainMesh        mesh = cube_and_wedge();
      PlainMesh::Field fat{"fat_fraction", 1, {}}, fibre{"fibre", 3, {}};
      double           sign = 1;
      for (const auto &x : mesh.points)
        {
          fat.values.push_back(0.2 + 0.1 * x[0] + 0.2 * x[1] - 0.1 * x[2]);
          fibre.values.insert(fibre.values.end(), {0.6 * sign, 0.8 * sign, 0});
          sign = -sign;
        }
      mesh.point_fields = {fat, fibre};
      const PointProperties properties(file_of(mesh));
      EXPECT_TRUE(properties.has_fat());
      EXPECT_FALSE(properties.has_matrix());
      for (const auto &x : places)
        {
          const auto [row, distance] = properties.nearest(x);
          EXPECT_EQ(distance, 0);
          EXPECT_NEAR(*row.fat, 0.2 + 0.1 * x[0] + 0.2 * x[1] - 0.1 * x[2], 1e-14);
          EXPECT_NEAR(std::abs((*row.direction)[0]), 0.6, 1e-14) << "vectors have no sign";
          EXPECT_NEAR(std::abs((*row.direction)[1]), 0.8, 1e-14);
        }
    }

    TEST(MeshFields, OfCellsHoldInThem)
    {
      PlainMesh mesh   = cube_and_wedge();
      mesh.cell_fields = {{"max_iso_stress_muscle", 1, {2e5, 3e5}},
                          {"tissue_id", 1, {1, 3}},
                          {"muscle_fibre_orientation", 3, {0, 0, 2, 0, 0, 0}},
                          {"other", 1, {7, 7}}};
      const PointProperties properties(file_of(mesh), 1e-2);
      EXPECT_EQ(properties.tissues(), (std::vector<unsigned int>{1, 3}));
      for (const auto &x : places)
        if (x[0] != 1)
          {
            const auto [row, distance] = properties.nearest(dealii::Point<3>(1e-2 * x));
            EXPECT_EQ(*row.stress, x[0] < 1 ? 2e5 : 3e5);
            EXPECT_EQ(*row.tissue, x[0] < 1 ? 1u : 3u);
            EXPECT_EQ(row.direction.has_value(), x[0] < 1) << "a vector of length zero says nothing";
          }
      // Beside the mesh its nearest place counts, and the distance is told.
      const auto [row, distance] = properties.nearest(dealii::Point<3>(0.005, 0.005, 0.013));
      EXPECT_EQ(*row.stress, 2e5);
      EXPECT_GE(distance, 0.003 - 1e-12);
      EXPECT_LT(distance, 0.004) << "no more than to a point of the nearest part";
    }

    TEST(MeshFields, WhatSaysNothingIsRefused)
    {
      const auto told = [](const PlainMesh &mesh, const std::string &words) {
        const std::string refusal = test::complaint([&] { PointProperties{file_of(mesh)}; });
        EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
      };
      PlainMesh mesh    = cube_and_wedge();
      mesh.point_fields = {{"temperature", 1, std::vector<double>(10, 37.)}};
      told(mesh, "it has group (1), temperature (1)");
      mesh.point_fields = {{"fat_fraction", 1, std::vector<double>(10, 37.)}};
      told(mesh, "row 0 of the array \"fat_fraction\" is 37");
    }
  } // namespace mesh_fields
} // namespace myolines
