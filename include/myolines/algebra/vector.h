// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace myolines
{
  /// Distributed vector of doubles: the locally owned entries and, always, the ghost entries that cells of this
  /// rank touch. The layout comes from a system (SemiDiscreteSystem::initial_state); all other vectors copy it.
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// Linear relations between unknowns, u = C q; the inhomogeneity g(t) belongs to the system.
  using Constraints = dealii::AffineConstraints<double>;
} // namespace myolines
