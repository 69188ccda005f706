// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/body/geometry.h>

namespace myolines
{
  /// The refined mesh of a body as lists, on this rank alone, in metres. Groups of cells are their volumes, or without one their tissues,
  /// by name; groups of faces count from 1 in the order of face_names(), without the rest. Its field "scaled jacobian" tells where
  /// cells are bad. As a mesh file it gives the same body.
  PlainMesh export_mesh(const Geometry &geometry, const TissueNames &tissues);
} // namespace myolines
