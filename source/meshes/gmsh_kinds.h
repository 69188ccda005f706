// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "formats.h"

#include <optional>

namespace myolines
{
  /// A type of elements of Gmsh.
  struct GmshKind
  {
    int                             dimension;
    std::size_t                     n_nodes; ///< the corners first
    std::optional<PlainMesh::Shape> shape;   ///< none: points and lines
    bool                            straight;
  };

  /// @throws InputError for numbers that are none, or of elements of more than four dimensions or polynomials.
  GmshKind gmsh_kind(std::int64_t type, const Cursor &cursor);

  /// Adds an element to each of its groups, or to none. Points and lines are passed over.
  void add_gmsh_element(const GmshKind &kind, const std::vector<int> &groups, const std::vector<std::int64_t> &nodes, PlainMesh &mesh,
                        MeshBuilder &builder);

  // The sections of versions 4.0 and 4.1, the cursor being behind the line of their name.
  using GmshEntities = std::map<std::pair<int, int>, std::vector<int>>; ///< groups by dimension and number

  void read_gmsh4_entities(Cursor &cursor, double version, bool partitioned, GmshEntities &entities);
  void read_gmsh4_nodes(Cursor &cursor, double version, MeshBuilder &builder);
  void read_gmsh4_elements(Cursor &cursor, double version, const GmshEntities &entities, PlainMesh &mesh, MeshBuilder &builder);
} // namespace myolines
