// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/fem/node_space.h>

namespace myolines
{
  /// Below 1/6 of a cell, the determinant of the map onto every cell is positive everywhere: its columns are convex combinations of edges,
  /// (1 + 2d on the diagonal, 2d beside it at most, in parts of the cell) and 1 - 2d > 2d + 2d.
  constexpr double largest_distortion = 0.16;

  /// Shifts every vertex of the mesh that make_block() made with the same arguments by up to @p amount in [0, largest_distortion] of a
  /// cell in each direction. The shift is a hash of the place of the vertex, so it is the same on all ranks and in all runs. Vertices on
  /// a face move within it: the box keeps its shape.
  void distort_block(NodeSpace::Mesh &mesh, const std::array<double, 3> &size, const std::array<unsigned int, 3> &cells,
                     unsigned int refinement, double amount);
} // namespace myolines
