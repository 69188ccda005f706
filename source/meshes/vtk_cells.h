// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "formats.h"

namespace myolines
{
  /// What both formats of VTK tell of an unstructured grid, put together piece by piece.
  class VtkGrid
  {
  public:
    VtkGrid(const Cursor &cursor, PlainMesh &mesh)
      : cursor_(cursor)
      , mesh_(mesh)
      , builder_(cursor, mesh)
    {}

    /// @p x: three coordinates of each point of a further piece.
    void add_points(const std::vector<double> &x);

    /// @p ends: where the points of each cell of the piece end in @p connectivity.
    void add_cells(const std::vector<double> &connectivity, const std::vector<double> &ends, const std::vector<double> &types);

    /// Numbers of the cells or points of the piece, any number of each. Other lengths are refused.
    void add_field(bool of_cells, const std::string &name, std::size_t n_components, const std::vector<double> &values);

    /// "3 1 muscle": dimension, number and name of a group.
    void add_group_name(const std::string &text);

    /// The grid as a mesh: fields of cells alone, groups by the field that has them. @throws if a group is not an integer.
    void finish();

  private:
    bool is_group(const std::string &name) const;
    void set_groups(const PlainMesh::Field &field);

    const Cursor                 &cursor_;
    PlainMesh                    &mesh_;
    MeshBuilder                   builder_;
    std::vector<PlainMesh::Field> cell_fields_;                                                   ///< of all cells of the file
    std::vector<std::size_t>      row_of_cell_, row_of_face_;                                     ///< in those fields
    std::size_t                   first_point_ = 0, first_cell_ = 0, n_points_ = 0, n_cells_ = 0; ///< of the piece; of all
  };
} // namespace myolines
