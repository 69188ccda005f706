// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/body/mesh_body.h>
#include <myolines/scene/scene.h>

namespace myolines
{
  /// Declaration of the body of a mesh file in the list `geometry`, and its reading.
  scene::Schema mesh_body_schema();
  /// Reads that list. @throws InputError as MeshBody.
  std::shared_ptr<const MeshBody> read_mesh_body(const scene::Node &node, const TissueNames &names);
} // namespace myolines
