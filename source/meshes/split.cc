// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/meshes/tetrahedra.h>

#include <algorithm>
#include <unordered_map>

namespace myolines
{
  namespace
  {
    using Shape   = PlainMesh::Shape;
    using Element = PlainMesh::Element;

    bool has(const PlainMesh &mesh, const Shape shape)
    {
      return std::any_of(mesh.cells.begin(), mesh.cells.end(), [shape](const Element &cell) { return cell.shape == shape; });
    }

    /// Triangles of a face, along the diagonal from the corner with the lowest number, turned as the face is.
    std::vector<Element> triangles_of(const Element &face)
    {
      const unsigned int   n      = n_corners(face.shape);
      const auto           lowest = std::min_element(face.corner.begin(), face.corner.begin() + n) - face.corner.begin();
      std::vector<Element> triangles;
      for (unsigned int i = 1; i + 1 < n; ++i)
        triangles.push_back(
            {Shape::triangle, face.group, {{face.corner[lowest], face.corner[(lowest + i) % n], face.corner[(lowest + i + 1) % n]}}});
      return triangles;
    }

    PlainMesh split_into_tetrahedra(const PlainMesh &mesh)
    {
      PlainMesh split = mesh;
      split.cells.clear();
      split.faces.clear();
      split.further_groups.clear();
      for (const Tetrahedron &part : tetrahedra_of(mesh))
        {
          if (const auto more = mesh.further_groups.find(part.cell); more != mesh.further_groups.end())
            split.further_groups[split.cells.size()] = more->second;
          split.cells.push_back(
              {Shape::tetrahedron, mesh.cells[part.cell].group, {{part.corner[0], part.corner[1], part.corner[2], part.corner[3]}}});
        }
      for (const Element &face : mesh.faces)
        for (const Element &triangle : triangles_of(face))
          split.faces.push_back(triangle);
      return split;
    }

    /// Three neighbours of each corner of a cell, counter-clockwise as seen from it when looking away from the cell's inside.
    const std::vector<std::array<unsigned int, 3>> &neighbours_of(const Shape shape)
    {
      static const std::vector<std::array<unsigned int, 3>> tetrahedron{{{1, 2, 3}}, {{0, 3, 2}}, {{0, 1, 3}}, {{0, 2, 1}}},
          wedge{{{1, 2, 3}}, {{2, 0, 4}}, {{0, 1, 5}}, {{5, 4, 0}}, {{3, 5, 1}}, {{4, 3, 2}}},
          hexahedron{{{1, 3, 4}}, {{2, 0, 5}}, {{3, 1, 6}}, {{0, 2, 7}}, {{7, 5, 0}}, {{4, 6, 1}}, {{5, 7, 2}}, {{6, 4, 3}}};
      return shape == Shape::tetrahedron ? tetrahedron : shape == Shape::wedge ? wedge : hexahedron;
    }

    /// Middles of edges, faces and cells as points, made once for all that share them.
    class Middles
    {
    public:
      explicit Middles(PlainMesh &mesh)
        : mesh_(mesh)
      {}

      unsigned int of(const std::vector<unsigned int> &corners)
      {
        FaceKey key{{no_corner, no_corner, no_corner, no_corner}};
        if (corners.size() > key.size())
          return add(corners);
        std::copy(corners.begin(), corners.end(), key.begin());
        std::sort(key.begin(), key.end());
        const auto [entry, fresh] = known_.emplace(key, 0);
        if (fresh)
          entry->second = add(corners);
        return entry->second;
      }

      /// One of its own.
      unsigned int add(const std::vector<unsigned int> &corners)
      {
        PlainMesh::Position middle{{0, 0, 0}};
        for (const unsigned int corner : corners)
          for (unsigned int c = 0; c < 3; ++c)
            middle[c] += mesh_.points[corner][c] / static_cast<double>(corners.size());
        mesh_.points.push_back(middle);
        return static_cast<unsigned int>(mesh_.points.size() - 1);
      }

    private:
      struct Hash
      {
        std::size_t operator()(const FaceKey &key) const
        {
          std::size_t hash = 0;
          for (const unsigned int v : key)
            hash = (hash ^ v) * 0x9E3779B97F4A7C15ULL + (hash >> 29);
          return hash;
        }
      };
      PlainMesh                                      &mesh_;
      std::unordered_map<FaceKey, unsigned int, Hash> known_;
    };

    /// Corners of the face of @p cell on which the three corners lie.
    std::vector<unsigned int> corners_of_face_with(const Element &cell, const unsigned int a, const unsigned int b, const unsigned int c)
    {
      std::vector<unsigned int> corners;
      for (const auto &face : faces_of(cell.shape))
        if (const auto on = [&](const unsigned int v) { return std::find(face.begin(), face.end(), v) != face.end(); };
            on(a) && on(b) && on(c))
          for (const unsigned int v : face)
            corners.push_back(cell.corner[v]);
      return corners;
    }

    void add_parts_of_cell(const Element &cell, Middles &middles, std::vector<Element> &cells)
    {
      const unsigned int centre     = middles.add({cell.corner.begin(), cell.corner.begin() + n_corners(cell.shape)});
      const auto        &neighbours = neighbours_of(cell.shape);
      for (unsigned int v = 0; v < neighbours.size(); ++v)
        {
          const auto &[a, b, c] = neighbours[v];
          const auto edge       = [&](const unsigned int other) { return middles.of({cell.corner[v], cell.corner[other]}); };
          const auto face       = [&](const unsigned int one, const unsigned int two) {
            return middles.of(corners_of_face_with(cell, v, one, two));
          };
          cells.push_back(
              {Shape::hexahedron, cell.group, {{cell.corner[v], edge(a), face(a, b), edge(b), edge(c), face(a, c), centre, face(b, c)}}});
        }
    }

    void add_parts_of_face(const Element &face, Middles &middles, std::vector<Element> &faces)
    {
      const unsigned int              n = n_corners(face.shape);
      const std::vector<unsigned int> corners(face.corner.begin(), face.corner.begin() + n);
      for (unsigned int i = 0; i < n; ++i)
        faces.push_back({Shape::quadrilateral,
                         face.group,
                         {{corners[i], middles.of({corners[i], corners[(i + 1) % n]}), middles.of(corners),
                           middles.of({corners[(i + n - 1) % n], corners[i]})}}});
    }
  } // namespace

  /// Cones over the triangles of all faces that do not have the corner with the lowest number, which is their apex.
  std::vector<Tetrahedron> tetrahedra_of(const PlainMesh &mesh)
  {
    std::vector<Tetrahedron> parts;
    for (std::size_t i = 0; i < mesh.cells.size(); ++i)
      {
        const Element     &cell = mesh.cells[i];
        const unsigned int apex = *std::min_element(cell.corner.begin(), cell.corner.begin() + n_corners(cell.shape));
        for (unsigned int f = 0; f < faces_of(cell.shape).size(); ++f)
          {
            const Element face = face_of(cell, f);
            const auto    end  = face.corner.begin() + n_corners(face.shape);
            if (std::find(face.corner.begin(), end, apex) == end)
              for (const Element &triangle : triangles_of(face)) // seen from outside: from the apex it is turned the other way
                parts.push_back({i, {{triangle.corner[0], triangle.corner[2], triangle.corner[1], apex}}});
          }
      }
    return parts;
  }

  PlainMesh split_into_hexahedra(const PlainMesh &mesh)
  {
    if (!has(mesh, Shape::tetrahedron) && !has(mesh, Shape::wedge) && !has(mesh, Shape::pyramid))
      return mesh;
    const PlainMesh whole = has(mesh, Shape::pyramid) ? split_into_tetrahedra(mesh) : mesh;
    PlainMesh       split = whole;
    split.cells.clear();
    split.faces.clear();
    split.further_groups.clear();
    split.cell_fields.clear();
    split.point_fields.clear();
    Middles middles(split);
    for (std::size_t i = 0; i < whole.cells.size(); ++i)
      {
        const std::size_t first = split.cells.size();
        add_parts_of_cell(whole.cells[i], middles, split.cells);
        if (const auto more = whole.further_groups.find(i); more != whole.further_groups.end())
          for (std::size_t part = first; part < split.cells.size(); ++part)
            split.further_groups[part] = more->second;
      }
    for (const Element &face : whole.faces)
      add_parts_of_face(face, middles, split.faces);
    return split;
  }
} // namespace myolines
