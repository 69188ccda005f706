// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/meshes/plain_mesh.h>

#include <filesystem>
#include <vector>

namespace myolines
{
  /// Hexahedra, or quadrilaterals of a surface, with fields at their points, as a file of VTK has them: for pictures, where a mesh of
  /// straight cells would lose the shape.
  struct FieldGrid
  {
    std::vector<PlainMesh::Position>       points; ///< as written, without a unit
    std::vector<std::vector<unsigned int>> cells;  ///< (k + 1)^3 points of each, the first index fastest: k is the degree of the cell
    std::vector<std::vector<unsigned int>> faces;  ///< (k + 1)^2 points of each, where the file has a surface
    std::vector<PlainMesh::Field>          fields; ///< at points
  };

  /// Reads a `.vtu` of hexahedra or of quadrilaterals, straight or of Lagrange's kind of any degree. @throws InputError as read_mesh()
  /// does, and for other cells, or both.
  FieldGrid read_field_grid(const std::filesystem::path &file);
} // namespace myolines
