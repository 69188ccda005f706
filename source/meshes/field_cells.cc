// SPDX-License-Identifier: LGPL-2.1-or-later
#include "field_cells.h"

#include <cmath>

namespace myolines
{
  namespace
  {
    /// k of (k + 1)^dim points, 0 if there is none.
    unsigned int degree_of(const std::size_t points, const unsigned int dim)
    {
      const auto        n      = static_cast<unsigned int>(std::lround(std::pow(static_cast<double>(points), 1. / dim)));
      const std::size_t square = static_cast<std::size_t>(n) * n;
      return (dim == 2 ? square : square * n) == points && n > 1 ? n - 1 : 0;
    }

    // Types of VTK.
    constexpr int quadrilateral = 9, hexahedron = 12, lagrange_quadrilateral = 70, lagrange_hexahedron = 72;
    constexpr int triquadratic_hexahedron = 29;
  } // namespace

  // The arrangement of vtkLagrangeHexahedron:
  // https://www.kitware.com/modeling-arbitrary-order-lagrange-finite-elements-in-the-visualization-toolkit
  std::size_t lagrange_place(const unsigned int i, const unsigned int j, const unsigned int k, const unsigned int n,
                             const bool swapped_edges)
  {
    const bool        at_i = i == 0 || i == n, at_j = j == 0 || j == n, at_k = k == 0 || k == n;
    const int         ends  = at_i + at_j + at_k;
    const std::size_t inner = n - 1, plane = inner * inner;
    if (ends == 3)
      return (i == 0 ? (j == 0 ? 0 : 3) : (j == 0 ? 1 : 2)) + (k == 0 ? 0 : 4);
    std::size_t place = 8;
    if (ends == 2)
      {
        if (!at_i)
          return place + (i - 1) + (j == 0 ? 0 : 2 * inner) + (k == 0 ? 0 : 4 * inner);
        if (!at_j)
          return place + (j - 1) + (i == 0 ? 3 * inner : inner) + (k == 0 ? 0 : 4 * inner);
        const std::size_t edge = i == 0 ? (j == 0 ? 0 : swapped_edges ? 2 : 3) : (j == 0 ? 1 : swapped_edges ? 3 : 2);
        return place + 8 * inner + (k - 1) + edge * inner;
      }
    place += 12 * inner;
    if (ends == 1)
      {
        if (at_i)
          return place + (j - 1) + inner * (k - 1) + (i == 0 ? 0 : plane);
        place += 2 * plane;
        if (at_j)
          return place + (i - 1) + inner * (k - 1) + (j == 0 ? 0 : plane);
        return place + 2 * plane + (i - 1) + inner * (j - 1) + (k == 0 ? 0 : plane);
      }
    return place + 6 * plane + (i - 1) + inner * ((j - 1) + inner * (k - 1));
  }

  // The same of vtkLagrangeQuadrilateral.
  std::size_t lagrange_place(const unsigned int i, const unsigned int j, const unsigned int n)
  {
    const bool        at_i = i == 0 || i == n, at_j = j == 0 || j == n;
    const std::size_t inner = n - 1;
    if (at_i && at_j)
      return i == 0 ? (j == 0 ? 0 : 3) : (j == 0 ? 1 : 2);
    if (at_j)
      return 4 + (i - 1) + (j == 0 ? 0 : 2 * inner);
    if (at_i)
      return 4 + (j - 1) + (i == 0 ? 3 * inner : inner);
    return 4 + 4 * inner + (i - 1) + inner * (j - 1);
  }

  void FieldCells::add_points(const std::vector<double> &x)
  {
    first_point_ = grid_.points.size();
    for (std::size_t p = 0; p + 2 < x.size(); p += 3)
      {
        if (!std::isfinite(x[p]) || !std::isfinite(x[p + 1]) || !std::isfinite(x[p + 2]))
          cursor_.refuse("a coordinate of point " + std::to_string(p / 3) + " is not finite", "numbers");
        grid_.points.push_back({{x[p], x[p + 1], x[p + 2]}});
      }
  }

  void FieldCells::add_cells(const std::vector<double> &connectivity, const std::vector<double> &ends, const std::vector<double> &types)
  {
    if (ends.size() != types.size())
      cursor_.refuse("there are " + std::to_string(types.size()) + " types of cells, but " + std::to_string(ends.size()) + " ends",
                     "as many");
    const std::size_t n_points = grid_.points.size() - first_point_;
    double            begin    = 0;
    for (std::size_t c = 0; c < types.size(); ++c)
      {
        const bool face = types[c] == quadrilateral || types[c] == lagrange_quadrilateral;
        if (!face && types[c] != hexahedron && types[c] != triquadratic_hexahedron && types[c] != lagrange_hexahedron)
          cursor_.refuse("cell " + std::to_string(c) + " is of type " + std::to_string(static_cast<int>(types[c])) + " of VTK",
                         "hexahedra (types 12 and 72) or quadrilaterals (9 and 70), as runs write them");
        if (!(ends[c] >= begin && ends[c] <= static_cast<double>(connectivity.size())))
          cursor_.refuse("the points of cell " + std::to_string(c) + " have no end", "ends that ascend", "the file is damaged");
        const auto         first = static_cast<std::size_t>(begin), size = static_cast<std::size_t>(ends[c]) - first;
        const bool         straight = types[c] == quadrilateral || types[c] == hexahedron || types[c] == triquadratic_hexahedron;
        const unsigned int dim = face ? 2 : 3, degree = !straight ? degree_of(size, dim) : size == (face ? 4u : 8u) ? 1 : 0;
        if (degree == 0)
          cursor_.refuse("cell " + std::to_string(c) + " has " + std::to_string(size) + " points",
                         std::string("the ") + (face ? "square" : "cube") + " of a number from 2 on");
        std::vector<unsigned int> points;
        for (std::size_t v = first; v < first + size; ++v)
          {
            if (!(connectivity[v] >= 0 && connectivity[v] < static_cast<double>(n_points)))
              cursor_.refuse("a point of cell " + std::to_string(c) + " is not there", "numbers of points", "the file is damaged");
            points.push_back(static_cast<unsigned int>(first_point_ + static_cast<std::size_t>(connectivity[v])));
          }
        if (face)
          add_face(points, degree);
        else
          add_cell(points, degree);
        begin = ends[c];
      }
  }

  void FieldCells::add_cell(const std::vector<unsigned int> &points, const unsigned int degree)
  {
    const bool                swapped = degree > 1 && has_swapped_edges(points, degree);
    std::vector<unsigned int> cell;
    for (unsigned int k = 0; k <= degree; ++k)
      for (unsigned int j = 0; j <= degree; ++j)
        for (unsigned int i = 0; i <= degree; ++i)
          cell.push_back(points[lagrange_place(i, j, k, degree, swapped)]);
    grid_.cells.push_back(std::move(cell));
  }

  void FieldCells::add_face(const std::vector<unsigned int> &points, const unsigned int degree)
  {
    std::vector<unsigned int> face;
    for (unsigned int j = 0; j <= degree; ++j)
      for (unsigned int i = 0; i <= degree; ++i)
        face.push_back(points[lagrange_place(i, j, degree)]);
    grid_.faces.push_back(std::move(face));
  }

  /// The edge from (0, n, 0) to (0, n, n) is where its points lie nearer to the straight line between these corners: files do not tell the
  /// version by which their cells are arranged.
  bool FieldCells::has_swapped_edges(const std::vector<unsigned int> &points, const unsigned int degree) const
  {
    const auto distance = [&](const bool swapped) {
      double sum = 0;
      for (unsigned int k = 1; k < degree; ++k)
        for (int c = 0; c < 3; ++c)
          {
            const auto   at = [&](const unsigned int l) { return grid_.points[points[lagrange_place(0, degree, l, degree, swapped)]][c]; };
            const double part = static_cast<double>(k) / degree, off = at(k) - (1 - part) * at(0) - part * at(degree);
            sum += off * off;
          }
      return sum;
    };
    return distance(true) < distance(false);
  }

  void FieldCells::add_field(const bool of_cells, const std::string &name, const std::size_t n_components,
                             const std::vector<double> &values)
  {
    if (of_cells)
      return;
    if (values.size() != n_components * (grid_.points.size() - first_point_))
      cursor_.refuse("the array \"" + name + "\" has " + std::to_string(values.size()) + " numbers",
                     std::to_string(n_components) + " for each point");
    for (PlainMesh::Field &field : grid_.fields)
      if (field.name == name && field.n_components == n_components)
        {
          field.values.insert(field.values.end(), values.begin(), values.end());
          return;
        }
    grid_.fields.push_back({name, static_cast<unsigned int>(n_components), values});
  }

  void FieldCells::finish()
  {
    if (!grid_.cells.empty() && !grid_.faces.empty())
      cursor_.refuse("there are hexahedra and quadrilaterals", "a body or its surface");
    for (const PlainMesh::Field &field : grid_.fields)
      if (field.values.size() != field.n_components * grid_.points.size())
        cursor_.refuse("the array \"" + field.name + "\" is not in all pieces", "the same arrays in each");
  }
} // namespace myolines
