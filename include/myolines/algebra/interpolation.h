// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/vector.h>

#include <vector>

namespace myolines
{
  /// Interpolation P from a coarse space of nodes to a fine one, three components a node and the same weights for each.
  /// Rows of constrained fine unknowns are zero.
  class Interpolation
  {
  public:
    /// Adds the row of the next owned fine node, ascending: local numbers and weights of coarse nodes (ghosts included),
    /// and for each component whether it is constrained.
    void add_row(const std::vector<std::pair<unsigned int, double>> &entries, const bool constrained[3]);

    /// fine += P coarse, owned entries; @p coarse needs no ghosts on entry.
    void add(const Vector &coarse, Vector &fine) const;

    /// coarse = P^T fine.
    void restrict_to(const Vector &fine, Vector &coarse) const;

  private:
    std::vector<unsigned int> row_start_{0};
    std::vector<unsigned int> columns_; ///< first local unknown of the coarse node
    std::vector<double>       weights_;
    std::vector<double>       free_; ///< 1 or 0 for each fine unknown
  };
} // namespace myolines
