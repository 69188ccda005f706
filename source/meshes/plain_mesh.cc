// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/meshes/plain_mesh.h>

#include <algorithm>

namespace myolines
{
  using Shape = PlainMesh::Shape;

  unsigned int n_corners(const Shape shape)
  {
    static constexpr unsigned int n[] = {3, 4, 4, 5, 6, 8};
    return n[static_cast<int>(shape)];
  }

  const std::vector<std::vector<unsigned int>> &faces_of(const Shape cell)
  {
    static const std::vector<std::vector<unsigned int>> none, tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
        pyramid{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
        wedge{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
        hexahedron{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    switch (cell)
      {
      case Shape::tetrahedron:
        return tetrahedron;
      case Shape::pyramid:
        return pyramid;
      case Shape::wedge:
        return wedge;
      case Shape::hexahedron:
        return hexahedron;
      default:
        return none;
      }
  }

  const std::string &plural(const Shape shape)
  {
    static const std::string names[] = {"triangles", "quadrilaterals", "tetrahedra", "pyramids", "wedges", "hexahedra"};
    return names[static_cast<int>(shape)];
  }

  double signed_volume(const PlainMesh &mesh, const PlainMesh::Element &cell)
  {
    const PlainMesh::Position &apex   = mesh.points[cell.corner[0]];
    double                     volume = 0;
    for (const auto &face : faces_of(cell.shape))
      for (std::size_t i = 2; i < face.size(); ++i)
        {
          double edge[3][3];
          for (unsigned int c = 0; c < 3; ++c)
            {
              edge[0][c] = mesh.points[cell.corner[face[0]]][c] - apex[c];
              edge[1][c] = mesh.points[cell.corner[face[i - 1]]][c] - apex[c];
              edge[2][c] = mesh.points[cell.corner[face[i]]][c] - apex[c];
            }
          for (unsigned int c = 0; c < 3; ++c)
            {
              const unsigned int d = (c + 1) % 3, e = (c + 2) % 3;
              volume += edge[0][c] * (edge[1][d] * edge[2][e] - edge[1][e] * edge[2][d]) / 6;
            }
        }
    return volume;
  }

  FaceKey face_key(const PlainMesh::Element &face)
  {
    FaceKey key{{face.corner[0], face.corner[1], face.corner[2], face.shape == Shape::triangle ? no_corner : face.corner[3]}};
    std::sort(key.begin(), key.end());
    return key;
  }

  PlainMesh::Element face_of(const PlainMesh::Element &cell, const unsigned int f)
  {
    const std::vector<unsigned int> &corners = faces_of(cell.shape)[f];
    PlainMesh::Element               face{corners.size() == 3 ? Shape::triangle : Shape::quadrilateral, 0, {}};
    for (std::size_t i = 0; i < corners.size(); ++i)
      face.corner[i] = cell.corner[corners[i]];
    return face;
  }

  std::vector<PlainMesh::Element> outer_faces(const PlainMesh &mesh)
  {
    std::vector<std::pair<FaceKey, PlainMesh::Element>> all;
    for (const PlainMesh::Element &cell : mesh.cells)
      for (unsigned int f = 0; f < faces_of(cell.shape).size(); ++f)
        {
          const PlainMesh::Element face = face_of(cell, f);
          all.emplace_back(face_key(face), face);
        }
    std::sort(all.begin(), all.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<PlainMesh::Element> outer;
    for (std::size_t i = 0; i < all.size();)
      {
        std::size_t next = i + 1;
        while (next < all.size() && all[next].first == all[i].first)
          ++next;
        if (next == i + 1)
          outer.push_back(all[i].second);
        i = next;
      }
    return outer;
  }
} // namespace myolines
