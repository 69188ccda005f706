// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace myolines::study
{
  /// A quantity over time; t ascends.
  struct Series
  {
    std::vector<double> t; ///< [s]
    std::vector<double> x; ///< values there
  };

  /// Why there is no measure of a column that has an infinite value or one that is no number.
  constexpr const char *not_finite = "the column is not finite";

  /// A number, or why there is none.
  struct Measured
  {
    std::optional<double> value; ///< nothing: see note
    std::string           note;  ///< why there is none; else empty
  };

  /// Measures of a series x(t) alone:
  ///   final, minimum, maximum
  ///   total variation        sum of |x_i - x_(i-1)|
  ///   growth                 largest |x| in the last quarter of the time over that in the first
  ///   decay time             [s] from the largest deviation |x - x_end| to the last instant at which it is above `fraction` of that;
  /// and beside a reference r(t), interpolated linearly at the times of x:
  ///   final error            |x - r| at the end
  ///   maximum error          the largest |x - r|
  ///   root mean square error sqrt(integral of (x - r)^2 dt / T), by the trapezoidal rule
  ///   overshoot              how far x leaves the range [min r, max r], over max r - min r
  ///   late overshoot         the same of x in the last quarter of the time alone
  ///   relative variation     total variation of x over that of r at the same times.
  std::vector<std::string> measure_names();
  std::vector<std::string> measure_names_with_reference(); ///< Those of the list that need a reference.
  /// True if the measure has no unit, whatever the column.
  bool is_ratio(const std::string &measure);

  /// What measures depend on beside the series.
  struct MeasureOptions
  {
    bool   relative = false; ///< errors over the largest |r|
    double fraction = 0.05;  ///< of the decay time
  };

  /// The measure @p name of @p series. @p reference is nullptr for measures of the series alone, otherwise as long as the series:
  /// reference_at().
  Measured measure(const std::string &name, const Series &series, const std::vector<double> *reference, const MeasureOptions &options);

  /// The part of @p series with from <= t <= until.
  Series window(const Series &series, std::optional<double> from, std::optional<double> until);

  /// Values of @p reference at the times @p t, linear in between; none if some t is outside its times by more than rounding.
  std::optional<std::vector<double>> reference_at(const Series &reference, const std::vector<double> &t);
} // namespace myolines::study
