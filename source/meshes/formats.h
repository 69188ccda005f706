// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cursor.h"

#include <myolines/meshes/plain_mesh.h>

#include <optional>
#include <unordered_map>

namespace myolines
{
  // One reader for each format, from the first byte of the file on.

  PlainMesh read_gmsh(Cursor &cursor);
  PlainMesh read_legacy_vtk(Cursor &cursor);
  PlainMesh read_vtu(Cursor &cursor);
  PlainMesh read_abaqus(Cursor &cursor);

  /// Puts together what the formats have in common: points with numbers of the file, and elements of them.
  class MeshBuilder
  {
  public:
    MeshBuilder(const Cursor &cursor, PlainMesh &mesh)
      : cursor_(cursor)
      , mesh_(mesh)
    {}

    void add_point(std::int64_t number, const PlainMesh::Position &x);

    /// A cell or a face whose first corners are @p numbers, in some groups or in none.
    void add(PlainMesh::Shape shape, const std::vector<int> &groups, const std::vector<std::int64_t> &numbers);

    /// Place of a point in the mesh, by its number in the file.
    std::optional<unsigned int> place(std::int64_t number) const;

  private:
    const Cursor                                  &cursor_;
    PlainMesh                                     &mesh_;
    std::unordered_map<std::int64_t, unsigned int> places_;
  };
} // namespace myolines
