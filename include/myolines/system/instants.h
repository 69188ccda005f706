// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/point.h>

#include <vector>

namespace myolines
{
  /// Times about @p t are one instant if they are no farther apart than this [s]: round-off, four units in the last place, or beside steps
  /// of @p size a billionth of a step.
  double time_tolerance(double t, double size = 0);

  /// Whether @p one and @p other are the same instant, beside steps of @p size if there are any.
  bool same_time(double one, double other, double size = 0);

  /// Whether something that begins at @p begin has begun at @p t: at the same instant (@p tolerance [s] apart) the side decides.
  bool has_begun(double begin, double t, Side side, double tolerance);

  /// @p times in ascending order, the last one of those that are the same instant: then all are behind.
  std::vector<double> one_list(std::vector<double> times);
} // namespace myolines
