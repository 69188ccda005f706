// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/fem/node_space.h>

namespace myolines
{
  /// Three translations and three rotations about the middle of the nodes, zero on constrained unknowns.
  std::vector<Vector> rigid_body_modes(const NodeSpace &space, const Constraints &constraints);
} // namespace myolines
