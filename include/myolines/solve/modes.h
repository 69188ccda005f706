// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/semi_discrete_system.h>

#include <deal.II/lac/full_matrix.h>

#include <complex>
#include <vector>

namespace myolines
{
  /// All w with det(w^2 M + w C + K) = 0, the growth rates and frequencies [1/s] of small motions e^(w t), the largest real part first;
  /// M or, where it is empty, C is regular. The small half of them is computed from the inverse problem, so that slow motions of stiff
  /// systems keep their digits, where K is regular. @throws SolveError for singular matrices.
  std::vector<std::complex<double>> quadratic_eigenvalues(const dealii::FullMatrix<double> &K, const dealii::FullMatrix<double> &C,
                                                          const dealii::FullMatrix<double> &M);

  /// The largest number of free unknowns for which modes() makes dense matrices.
  constexpr unsigned int most_unknowns_of_modes = 2000;

  /// Those of @p system linearised at the admissible @p state, its free unknowns only; dense, on one rank.
  /// @throws InputError for more ranks, more unknowns, or unknowns of several orders in time.
  std::vector<std::complex<double>> modes(const SemiDiscreteSystem &system, const State &state);
} // namespace myolines
