// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

namespace myolines::study
{
  /// A value that was computed with steps, cells or tolerances of some size.
  struct Sample
  {
    double size;  ///< of steps, cells or tolerances
    double value; ///< of the quantity
  };

  /// How values approach their limit as sizes go down.
  enum class Approach
  {
    at_once,         ///< there is no difference
    as_in_theory,    ///< the observed rate is within a tenth of that of theory
    at_another_rate, ///< monotone, at a rate that is not that of theory
    alternating,     ///< differences change sign and shrink
    irregular,       ///< differences do not shrink: there is no rate
    unseen           ///< two values show no rate
  };

  /// An estimate, and what it rests on.
  struct DiscretisationError
  {
    double                error = 0;  ///< of the value asked for; not negative
    Approach              approach;   ///< what the values show
    std::optional<double> rate;       ///< observed, where values are monotone
    std::optional<double> assumed;    ///< at which errors are taken to go down, size^rate; none if irregular or at once
    double                safety = 1; ///< factor in the error
    double                likely = 0; ///< the error without the factor of safety
  };

  /// The error of @p samples[@p which]: its distance from the value of the smallest size, plus the error of that one. With r the ratio of
  /// two neighbouring sizes, d the difference of the values of the two smallest ones and q = @p order that of theory, the latter is
  ///   F |d| / (r^q - 1), F = 1.25, where the rate p observed from three values is within a tenth of q;
  ///   F |d| / (r^s - 1), F = 3, where it is not, s = min(max(p, 0.5), q); where the differences alternate, s likewise with min(1, q) for q
  ///   and p from their absolute values; and of two values, which show no rate, s = min(1, q);
  ///   3 times the range of all values, in place of the whole sum, where the differences do not shrink.
  /// That is Richardson's extrapolation with the factors of safety of the grid convergence index (Roache, doi:10.1115/1.2910291), by the
  /// rules of Oberkampf and Roy (doi:10.1017/CBO9780511760396, section 8.7); without a rate that of Eca and Hoekstra
  /// (doi:10.1016/j.jcp.2014.01.006). An estimate, no bound.
  /// @p samples are two or three, sizes descending at one ratio.
  DiscretisationError discretisation_error(const std::vector<Sample> &samples, std::size_t which, double order);
} // namespace myolines::study
