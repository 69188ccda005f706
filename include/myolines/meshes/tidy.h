// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/meshes/plain_mesh.h>

namespace myolines
{
  /// What was put right in a mesh.
  struct Tidying
  {
    std::size_t unused = 0; ///< points of no cell, dropped
    std::size_t loose  = 0; ///< faces with points of no cell, dropped
    std::size_t joined = 0; ///< points at the place of another one, which took their place
    std::size_t turned = 0; ///< left-handed cells, turned
    std::size_t twice  = 0; ///< cells that were there already
  };

  /// Leaves in @p mesh only points of cells, one at each place (within a millionth of the size of the box around them), and every cell
  /// once, in all its groups, right-handed. Faces whose points are at no place of these are dropped. Fields keep their rows only where
  /// nothing is dropped: they are left out otherwise.
  Tidying tidy(PlainMesh &mesh);

  /// Low and high corner of the box around the cells.
  std::array<PlainMesh::Position, 2> box_around(const PlainMesh &mesh);

  /// A cell of each part of the mesh that has no point in common with the others.
  std::vector<std::size_t> parts_of(const PlainMesh &mesh);

  /// A cell of each part that has no face in common with the others: what it shares with them are edges and points, which are hinges.
  std::vector<std::size_t> parts_without_common_faces(const PlainMesh &mesh);

  /// Triangles of the boundary that lie on half of a quadrilateral of it: cells meet there that do not fit each other.
  std::vector<PlainMesh::Element> unfitting_faces(const PlainMesh &mesh);

  /// Points that lie on a face of the boundary and are no corner of it: cells meet there that do not fit each other.
  std::vector<PlainMesh::Position> hanging_points(const PlainMesh &mesh);
} // namespace myolines
