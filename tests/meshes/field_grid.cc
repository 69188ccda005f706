// SPDX-License-Identifier: LGPL-2.1-or-later
// Fields of runs as files of VTK have them: cells of Lagrange's kind of any degree.

#include "../support/complaint.h"
#include "../support/temporary.h"

#include <myolines/meshes/field_grid.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace myolines;

namespace
{
  using Place = std::array<int, 3>; // of a point in its cell, from 0 to the degree in each direction

  /// The points between two corners, seen from the first.
  void add_between(std::vector<Place> &places, const Place &a, const Place &b, const int n)
  {
    for (int s = 1; s < n; ++s)
      places.push_back({{a[0] + s * (b[0] - a[0]) / n, a[1] + s * (b[1] - a[1]) / n, a[2] + s * (b[2] - a[2]) / n}});
  }

  /// Those of a hexahedron in the order of VTK: corners, edges as pairs of corners, faces, inside. VTK 8 had the last two edges the other
  /// way round.
  std::vector<Place> places_of_hexahedron(const int n, const bool of_vtk_8)
  {
    std::vector<Place> p    = {{{0, 0, 0}}, {{n, 0, 0}}, {{n, n, 0}}, {{0, n, 0}}, {{0, 0, n}}, {{n, 0, n}}, {{n, n, n}}, {{0, n, n}}};
    using Edge              = std::pair<int, int>;
    std::vector<Edge> edges = {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    if (of_vtk_8)
      std::swap(edges[10], edges[11]);
    for (const auto &[a, b] : edges)
      add_between(p, Place(p[a]), Place(p[b]), n);
    for (int normal = 0; normal < 3; ++normal)
      for (const int side : {0, n})
        for (int t = 1; t < n; ++t)
          for (int s = 1; s < n; ++s)
            p.push_back(normal == 0 ? Place{{side, s, t}} : normal == 1 ? Place{{s, side, t}} : Place{{s, t, side}});
    for (int k = 1; k < n; ++k)
      for (int j = 1; j < n; ++j)
        for (int i = 1; i < n; ++i)
          p.push_back({{i, j, k}});
    return p;
  }

  std::vector<Place> places_of_quadrilateral(const int n)
  {
    std::vector<Place> p = {{{0, 0, 0}}, {{n, 0, 0}}, {{n, n, 0}}, {{0, n, 0}}};
    for (const auto &[a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(3, 2), std::pair(0, 3)})
      add_between(p, Place(p[a]), Place(p[b]), n);
    for (int j = 1; j < n; ++j)
      for (int i = 1; i < n; ++i)
        p.push_back({{i, j, 0}});
    return p;
  }

  /// A piece of a file with one cell of @p type, its points in the order of @p places, and the field "sum" of their coordinates.
  std::string piece_of(const std::vector<Place> &places, const int type, const std::string &ends = "")
  {
    std::ostringstream points, connectivity, sums;
    for (std::size_t v = 0; v < places.size(); ++v)
      {
        points << places[v][0] << " " << places[v][1] << " " << places[v][2] << "\n";
        connectivity << v << " ";
        sums << places[v][0] + places[v][1] + places[v][2] << " ";
      }
    const auto array = [](const std::string &name, const std::string &numbers, const std::string &more = "") {
      return "<DataArray type=\"Float64\" Name=\"" + name + "\" " + more + " format=\"ascii\">" + numbers + "</DataArray>\n";
    };
    return "<Piece NumberOfPoints=\"" + std::to_string(places.size()) + "\" NumberOfCells=\"1\">\n<Points>" +
           array("Points", points.str(), "NumberOfComponents=\"3\"") + "</Points>\n<Cells>" + array("connectivity", connectivity.str()) +
           array("offsets", ends.empty() ? std::to_string(places.size()) : ends) + array("types", std::to_string(type)) +
           "</Cells>\n<PointData>" + array("sum", sums.str()) + "</PointData>\n</Piece>\n";
  }

  FieldGrid read(const std::string &pieces)
  {
    const auto file = test::temporary("field_grid.vtu");
    std::ofstream(file) << "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
                        << pieces << "</UnstructuredGrid>\n</VTKFile>\n";
    return read_field_grid(file);
  }
  std::string refusal(const std::string &pieces)
  {
    return test::complaint([&] { read(pieces); });
  }

  /// Whether the points of @p cell, the first index fastest, are where they belong.
  void expect_lattice(const FieldGrid &grid, const std::vector<unsigned int> &cell, const int n, const int layers)
  {
    ASSERT_EQ(cell.size(), static_cast<std::size_t>((n + 1) * (n + 1) * (layers + 1)));
    std::size_t v = 0;
    for (int k = 0; k <= layers; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i, ++v)
          {
            EXPECT_EQ(grid.points[cell[v]], (PlainMesh::Position{{double(i), double(j), double(k)}})) << n << ": " << i << j << k;
            EXPECT_EQ(grid.fields.at(0).values[cell[v]], i + j + k);
          }
  }

  TEST(FieldGridFile, HasThePointsOfCurvedCellsInOrder)
  {
    for (const int n : {2, 3, 4})
      {
        for (const bool of_vtk_8 : {false, true})
          {
            const FieldGrid grid = read(piece_of(places_of_hexahedron(n, of_vtk_8), 72));
            ASSERT_EQ(grid.cells.size(), 1u);
            expect_lattice(grid, grid.cells[0], n, n);
          }
        const FieldGrid surface = read(piece_of(places_of_quadrilateral(n), 70));
        ASSERT_EQ(surface.faces.size(), 1u);
        expect_lattice(surface, surface.faces[0], n, 0);
      }
    const FieldGrid straight = read(piece_of(places_of_hexahedron(1, false), 12));
    expect_lattice(straight, straight.cells.at(0), 1, 1);
  }

  TEST(FieldGridFile, JoinsItsPieces)
  {
    const std::string piece = piece_of(places_of_hexahedron(2, false), 72);
    const FieldGrid   grid  = read(piece + piece);
    ASSERT_EQ(grid.cells.size(), 2u);
    ASSERT_EQ(grid.fields.size(), 1u);
    EXPECT_EQ(grid.fields[0].values.size(), 54u);
    expect_lattice(grid, grid.cells[1], 2, 2);
    EXPECT_GE(grid.cells[1][0], 27u) << "points of its own piece";
  }

  TEST(FieldGridFile, RefusesWhatItCannotShow)
  {
    const std::vector<Place> hexahedron = places_of_hexahedron(2, false);
    std::vector<Place>       few(hexahedron.begin(), hexahedron.end() - 1);
    EXPECT_NE(refusal(piece_of(hexahedron, 10)).find("of type 10"), std::string::npos);
    EXPECT_NE(refusal(piece_of(few, 72)).find("has 26 points"), std::string::npos);
    EXPECT_NE(refusal(piece_of(hexahedron, 12)).find("has 27 points"), std::string::npos) << "straight ones have eight";
    EXPECT_NE(refusal(piece_of(hexahedron, 72, "28")).find("have no end"), std::string::npos);
    EXPECT_NE(refusal(piece_of(hexahedron, 72, "27 27")).find("1 types of cells, but 2 ends"), std::string::npos);
    EXPECT_NE(refusal(piece_of(hexahedron, 72) + piece_of(places_of_quadrilateral(2), 70)).find("hexahedra and quadrilaterals"),
              std::string::npos);
    std::string other = piece_of(hexahedron, 72);
    other.replace(other.find("\"sum\""), 5, "\"two\"");
    EXPECT_NE(refusal(piece_of(hexahedron, 72) + other).find("is not in all pieces"), std::string::npos);
    other.replace(other.find("connectivity\"  format=\"ascii\">0"), 31, "connectivity\"  format=\"ascii\">27");
    EXPECT_NE(refusal(other).find("is not there"), std::string::npos);
  }
} // namespace
