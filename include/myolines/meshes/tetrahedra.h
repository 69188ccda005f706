// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/meshes/plain_mesh.h>

namespace myolines
{
  /// A part of a cell.
  struct Tetrahedron
  {
    std::size_t                 cell;   ///< place in the list of cells
    std::array<unsigned int, 4> corner; ///< places in the list of points
  };

  /// The cells cut into tetrahedra along the diagonals of their faces from the corner with the lowest number, so that they fit together:
  /// 6 of a hexahedron, 3 of a wedge, 2 of a pyramid; right-handed where the cells are.
  std::vector<Tetrahedron> tetrahedra_of(const PlainMesh &mesh);
} // namespace myolines
