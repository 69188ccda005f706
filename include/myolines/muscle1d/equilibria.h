// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle1d/hill_force.h>

#include <vector>

namespace myolines
{
  /// A muscle of N elements in series at rest, its length fixed: every element has the same force. A stretch at which the isometric force
  /// rises again or falls begins a branch of it; elements on the same branch have the same stretch.
  struct ChainEquilibrium
  {
    double                    force;     ///< over F_0
    std::vector<unsigned int> elements;  ///< on each branch, short stretches first
    std::vector<double>       stretches; ///< on each branch, also of those without elements
    std::vector<double>       slopes;    ///< of the force there

    /// Directions in which it is left, of N - 1. With k_i the slope of element i: the number of negative ones, less one if sum 1/k_i < 0
    /// (the inertia of diag(k) where the stretches sum to a constant; Sylvester). Force-velocity has no say in it.
    unsigned int unstable_directions;
  };

  /// All equilibria of @p n_elements at the mean stretch @p stretch with the activation @p activation, thesis 3.2, by the numbers of
  /// elements on the branches. Which of the elements are on which branch makes n!/(n_1! n_2! ...) of each, all alike. Roots nearer to each
  /// other than 1/500 of the common range of forces may be missed; cost n^(branches - 1).
  std::vector<ChainEquilibrium> chain_equilibria(const HillForce &force, double activation, unsigned int n_elements, double stretch);
} // namespace myolines
