// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cursor.h"

#include <myolines/meshes/field_grid.h>

namespace myolines
{
  /// What the pieces of a `.vtu` tell, put together as a FieldGrid; for the reader of that format, as VtkGrid is.
  class FieldCells
  {
  public:
    FieldCells(const Cursor &cursor, FieldGrid &grid)
      : cursor_(cursor)
      , grid_(grid)
    {}

    void add_points(const std::vector<double> &x);
    void add_cells(const std::vector<double> &connectivity, const std::vector<double> &ends, const std::vector<double> &types);
    void add_field(bool of_cells, const std::string &name, std::size_t n_components, const std::vector<double> &values);
    void add_group_name(const std::string &) {}
    void finish();

  private:
    void add_cell(const std::vector<unsigned int> &points, unsigned int degree);
    void add_face(const std::vector<unsigned int> &points, unsigned int degree);
    bool has_swapped_edges(const std::vector<unsigned int> &points, unsigned int degree) const;

    const Cursor &cursor_;
    FieldGrid    &grid_;
    std::size_t   first_point_ = 0; ///< of the piece
  };

  /// Where VTK has the point (i, j, k) of a hexahedron of degree @p n: corners, then points within edges, faces and the cell. Versions of
  /// VTK before 9 had two of the edges swapped.
  std::size_t lagrange_place(unsigned int i, unsigned int j, unsigned int k, unsigned int n, bool swapped_edges);
  /// Where it has the point (i, j) of a quadrilateral: corners, then points within edges and the face.
  std::size_t lagrange_place(unsigned int i, unsigned int j, unsigned int n);
} // namespace myolines
