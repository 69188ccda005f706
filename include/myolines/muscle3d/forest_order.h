// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/discretisation.h>

namespace myolines
{
  /// Owned cells in the order of the forest (trees, then children in each), in which ranks own consecutive pieces: the pieces of all
  /// ranks, one after the other, are the same sequence for any number of ranks.
  std::vector<NodeSpace::Cell> cells_in_forest_order(const Muscle3dDiscretisation &discretisation);
} // namespace myolines
