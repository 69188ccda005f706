// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/point.h>

#include <vector>

namespace myolines
{
  // Hexahedra of eight vertices as lists, before they are a mesh: x are places of vertices [m], v the vertices of one of them, row by
  // row.

  /// Scaled Jacobian: the smallest determinant at a corner over the lengths of its three edges; 1 for a brick, not positive for cells
  /// that are inverted or degenerate.
  double scaled_jacobian(const std::vector<dealii::Point<3>> &x, const unsigned int *v);

  /// Volume of the trilinear image of the unit cube [m^3].
  double cell_volume(const std::vector<dealii::Point<3>> &x, const unsigned int *v);
} // namespace myolines
