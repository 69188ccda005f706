// SPDX-License-Identifier: LGPL-2.1-or-later
// What becomes of cells that are no hexahedra, and what is put right.
#include <myolines/meshes/tidy.h>

#include <gtest/gtest.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    using Shape = PlainMesh::Shape;

    double volume_of(const PlainMesh &mesh)
    {
      double volume = 0;
      for (const auto &cell : mesh.cells)
        volume += signed_volume(mesh, cell);
      return volume;
    }

    /// The unit cube as a hexahedron, on it along x a wedge (half a cube), and on the top of the cube a pyramid or two tetrahedra.
    PlainMesh mixed(const bool pyramid)
    {
      PlainMesh mesh;
      mesh.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}, {{0, 0, 1}},    {{1, 0, 1}},
                     {{1, 1, 1}}, {{0, 1, 1}}, {{2, 0, 0}}, {{2, 1, 0}}, {{0.5, 0.5, 2}}};
      mesh.cells  = {{Shape::hexahedron, 1, {{0, 1, 2, 3, 4, 5, 6, 7}}}, {Shape::wedge, 1, {{1, 5, 8, 2, 6, 9}}}};
      if (pyramid)
        mesh.cells.push_back({Shape::pyramid, 2, {{4, 5, 6, 7, 10}}});
      mesh.faces = {{Shape::quadrilateral, 5, {{0, 3, 7, 4}}}, {Shape::triangle, 6, {{1, 5, 8}}}};
      return mesh;
    }

    PlainMesh tetrahedron()
    {
      PlainMesh mesh;
      mesh.points = {{{0, 0, 0}}, {{3, 0, 0}}, {{0, 2, 0}}, {{0, 0, 1}}};
      mesh.cells  = {{Shape::tetrahedron, 1, {{0, 1, 2, 3}}}};
      mesh.faces  = {{Shape::triangle, 4, {{1, 2, 3}}}};
      return mesh;
    }

    /// Positive at all corners, faces of the boundary as many as expected, those with a name among them.
    void expect_sound(const PlainMesh &split, const std::size_t cells, const std::size_t outer, const double volume)
    {
      EXPECT_EQ(split.cells.size(), cells);
      EXPECT_NEAR(volume_of(split), volume, 1e-12);
      for (const auto &cell : split.cells)
        {
          EXPECT_EQ(cell.shape, Shape::hexahedron);
          EXPECT_GT(signed_volume(split, cell), 0);
        }
      std::map<FaceKey, int> boundary;
      const auto             faces = outer_faces(split);
      for (const auto &face : faces)
        ++boundary[face_key(face)];
      EXPECT_EQ(faces.size(), outer);
      for (const auto &face : split.faces)
        EXPECT_EQ(boundary.count(face_key(face)), 1u);
      EXPECT_EQ(parts_of(split).size(), 1u);
      EXPECT_TRUE(hanging_points(split).empty());
    }

    TEST(Split, ATetrahedronBecomesFourHexahedra)
    {
      const PlainMesh split = split_into_hexahedra(tetrahedron());
      expect_sound(split, 4, 12, 1);
      EXPECT_EQ(split.faces.size(), 3u);
      EXPECT_EQ(split.faces[0].group, 4);
    }

    TEST(Split, WedgesAndHexahedraStayJoined)
    {
      PlainMesh mesh = mixed(false);
      tidy(mesh);
      ASSERT_NEAR(volume_of(mesh), 1.5, 1e-14);
      // Of 5 + 2 quadrilaterals and 2 triangles outside 4 each and 3 each.
      expect_sound(split_into_hexahedra(mesh), 8 + 6, 4 * 7 + 3 * 2, 1.5);
    }

    TEST(Split, PyramidsTakeAllCellsToTetrahedra)
    {
      PlainMesh mesh = mixed(true);
      tidy(mesh);
      ASSERT_NEAR(volume_of(mesh), 1.5 + 1. / 3, 1e-14);
      const PlainMesh split = split_into_hexahedra(mesh);
      expect_sound(split, 4 * (6 + 3 + 2), 3 * (2 * 6 + 2 + 4), 1.5 + 1. / 3);
      EXPECT_EQ(std::count_if(split.cells.begin(), split.cells.end(), [](const auto &cell) { return cell.group == 2; }), 8);
    }

    TEST(Split, HexahedraStayAsTheyAre)
    {
      PlainMesh mesh = mixed(false);
      mesh.cells.resize(1);
      mesh.faces.resize(1);
      EXPECT_EQ(split_into_hexahedra(mesh).cells.size(), 1u);
    }

    TEST(Tidy, CellsAreTurned)
    {
      for (const bool pyramid : {false, true})
        {
          PlainMesh mesh = mixed(pyramid);
          tidy(mesh);
          const double volume = volume_of(mesh);
          for (auto &x : mesh.points)
            x[2] = -x[2];
          EXPECT_EQ(tidy(mesh).turned, mesh.cells.size());
          EXPECT_NEAR(volume_of(mesh), volume, 1e-14);
          EXPECT_EQ(tidy(mesh).turned, 0u);
        }
    }

    /// Two cubes with points of their own, one of them there twice, and a point of no cell.
    TEST(Tidy, PointsAreJoinedAndDropped)
    {
      PlainMesh mesh = mixed(false);
      mesh.cells.resize(1);
      mesh.faces = {{Shape::quadrilateral, 5, {{0, 3, 7, 4}}}};
      for (int i = 0; i < 8; ++i)
        mesh.points.push_back({{mesh.points[i][0] + 1 + 1e-9, mesh.points[i][1], mesh.points[i][2]}});
      mesh.cells.push_back({Shape::hexahedron, 1, {{11, 12, 13, 14, 15, 16, 17, 18}}});
      mesh.cells.push_back({Shape::hexahedron, 3, {{15, 11, 14, 18, 16, 12, 13, 17}}});
      EXPECT_EQ(parts_of(mesh).size(), 2u);
      const Tidying done = tidy(mesh);
      EXPECT_EQ(done.joined, 4u);
      EXPECT_EQ(done.unused, 3u);
      EXPECT_EQ(done.twice, 1u);
      EXPECT_EQ(mesh.points.size(), 12u);
      EXPECT_EQ(mesh.cells.size(), 2u);
      EXPECT_EQ(mesh.further_groups.at(1), std::vector<int>{3});
      EXPECT_EQ(parts_of(mesh).size(), 1u);
      EXPECT_EQ(outer_faces(mesh).size(), 10u);
    }

    /// Two cubes that share a face, an edge or a point.
    TEST(Parts, EdgesAndPointsAreHinges)
    {
      for (const int shared : {4, 2, 1})
        {
          PlainMesh mesh = mixed(false);
          mesh.cells.resize(1);
          mesh.points.resize(8);
          const double y = shared < 4 ? 1 : 0, z = shared < 2 ? 1 : 0;
          for (int i = 0; i < 8; ++i)
            mesh.points.push_back({{mesh.points[i][0] + 1, mesh.points[i][1] + y, mesh.points[i][2] + z}});
          mesh.cells.push_back({Shape::hexahedron, 1, {{8, 9, 10, 11, 12, 13, 14, 15}}});
          EXPECT_EQ(tidy(mesh).joined, static_cast<std::size_t>(shared));
          EXPECT_EQ(parts_of(mesh).size(), 1u);
          EXPECT_EQ(parts_without_common_faces(mesh).size(), shared == 4 ? 1u : 2u);
          EXPECT_TRUE(unfitting_faces(mesh).empty());
        }
    }

    /// On the square top of the cube two tetrahedra, whose triangles are no face of the cube; a pyramid there fits.
    TEST(Parts, TrianglesOnAQuadrilateralDoNotFit)
    {
      PlainMesh mesh = mixed(false);
      mesh.cells.push_back({Shape::tetrahedron, 1, {{4, 5, 6, 10}}});
      mesh.cells.push_back({Shape::tetrahedron, 1, {{4, 6, 7, 10}}});
      EXPECT_EQ(parts_of(mesh).size(), 1u);
      EXPECT_EQ(parts_without_common_faces(mesh).size(), 2u);
      EXPECT_EQ(unfitting_faces(mesh).size(), 2u);
      EXPECT_TRUE(unfitting_faces(mixed(true)).empty());
    }

    /// A surface that was meshed apart has copies of the points; a face that lies nowhere on the cells has others, and a point far away
    /// says nothing of how near points of one place are.
    TEST(Tidy, SurfacesGetThePointsOfTheCells)
    {
      PlainMesh mesh = mixed(false);
      mesh.cells.resize(1);
      for (const int i : {0, 3, 7, 4})
        mesh.points.push_back(mesh.points[i]);
      mesh.points.push_back({{1e9, 0, 0}});
      mesh.faces         = {{Shape::quadrilateral, 5, {{11, 12, 13, 14}}}, {Shape::triangle, 6, {{5, 8, 9}}}};
      const Tidying done = tidy(mesh);
      EXPECT_EQ(mesh.points.size(), 8u);
      EXPECT_EQ(done.joined, 4u);
      EXPECT_EQ(done.loose, 1u);
      ASSERT_EQ(mesh.faces.size(), 1u);
      EXPECT_EQ(face_key(mesh.faces[0]), (FaceKey{{0, 3, 4, 7}}));
    }

    TEST(Tidy, HangingPointsAreFound)
    {
      for (const double height : {0.5, 0.3, 1.}) // of the lower of two cells beside the cube; 1: there is one, which fits
        {
          PlainMesh mesh = mixed(false);
          mesh.cells.resize(1);
          const auto add = [&mesh](const double low, const double high) {
            for (const double z : {low, high})
              for (const auto &[x, y] : {std::pair(1., 0.), std::pair(2., 0.), std::pair(2., 1.), std::pair(1., 1.)})
                mesh.points.push_back({{x, y, z}});
            const unsigned int n = static_cast<unsigned int>(mesh.points.size());
            mesh.cells.push_back({Shape::hexahedron, 1, {{n - 8, n - 7, n - 6, n - 5, n - 4, n - 3, n - 2, n - 1}}});
          };
          add(0, height);
          if (height < 1)
            add(height, 1);
          tidy(mesh);
          const auto hanging = hanging_points(mesh);
          EXPECT_EQ(hanging.empty(), height == 1) << height;
          for (const auto &x : hanging)
            EXPECT_EQ(x[2], height);
        }
    }
  } // namespace
} // namespace myolines
