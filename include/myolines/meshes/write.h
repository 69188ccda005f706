// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/meshes/plain_mesh.h>

namespace myolines
{
  /// Endings of files that meshes can be written to: ".vtu", ".msh".
  const std::vector<std::string> &mesh_endings();

  /// @p mesh as the text of a file with one of the endings: VTK XML or Gmsh 2.2, both ASCII, with numbers that read back exactly. Groups
  /// and their names are kept by both, fields by VTK alone. Reading gives the same mesh back.
  std::string mesh_text(const PlainMesh &mesh, const std::string &ending);
} // namespace myolines
