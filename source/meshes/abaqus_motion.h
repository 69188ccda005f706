// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cursor.h"

#include <myolines/meshes/plain_mesh.h>

#include <vector>

namespace myolines
{
  /// Where the instance of a part is in an assembly of Abaqus: moved, and then turned about an axis in space.
  class AbaqusMotion
  {
  public:
    /// The next line of data below *INSTANCE: a translation, then two points of the axis and an angle [degrees], which turns like a
    /// right-handed screw on its way from the first to the second. @throws InputError for others.
    void add(const std::vector<double> &numbers, const Cursor &cursor);

    PlainMesh::Position of(const PlainMesh::Position &x) const;

  private:
    unsigned int        n_lines_ = 0;
    PlainMesh::Position translation_{}, origin_{}, axis_{}; ///< axis of unit length
    double              cosine_ = 1, sine_ = 0;
  };
} // namespace myolines
