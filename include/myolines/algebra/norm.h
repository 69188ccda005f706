// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/vector.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace myolines
{
  /// l2 norm over all ranks. Unlike that of the vector class it may be NaN in builds with assertions. Collective.
  inline double norm_or_nan(const Vector &x)
  {
    double squares = 0;
    for (const double entry : x)
      squares += entry * entry;
    return std::sqrt(dealii::Utilities::MPI::sum(squares, x.get_mpi_communicator()));
  }
} // namespace myolines
