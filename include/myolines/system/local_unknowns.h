// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/aligned_vector.h>

namespace myolines
{
  /// Unknowns z of single cells that a system eliminates, z = z(u), and that Newton's method carries as iterates of their own beside
  /// u: see SemiDiscreteSystem::local(). A plain value, owned by whoever owns the iterate u; what its numbers mean is the system's
  /// affair. Empty: the system has none.
  struct LocalUnknowns
  {
    dealii::AlignedVector<double> values; ///< of the cells of this rank

    bool any() const { return !values.empty(); } ///< whether there are any
  };
} // namespace myolines
