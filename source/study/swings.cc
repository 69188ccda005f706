// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/study/swings.h>

#include <algorithm>
#include <cmath>

namespace myolines::study
{
  namespace
  {
    /// Equal neighbours, as on both sides of a peak, go on in the direction before.
    Series turning_points(const Series &series)
    {
      Series turns;
      double before = 0;
      for (std::size_t i = 1; i < series.x.size(); ++i)
        {
          const double change = series.x[i] - series.x[i - 1];
          if (change * before < 0)
            {
              turns.t.push_back(series.t[i - 1]);
              turns.x.push_back(series.x[i - 1]);
            }
          if (change != 0)
            before = change;
        }
      return turns;
    }

    Series rows_about(const Series &series, const double t, const double width)
    {
      const double first = series.t.front(), last = series.t.back();
      const double from = std::max(first, std::min(t - width / 2, last - width)), until = std::max(t + width / 2, from + width);
      return window(series, from, until);
    }
  } // namespace

  double amplitude_about(const Series &series, const double t, const double width)
  {
    if (series.t.empty())
      return 0;
    const Series turns = turning_points(rows_about(series, t, width));
    if (turns.x.size() < 3)
      return 0;
    const auto  distance = [&](const std::size_t i) { return std::abs(turns.t[i] - t); };
    std::size_t middle   = 1; // of the three turning points that are nearest
    for (std::size_t i = 2; i + 1 < turns.x.size(); ++i)
      if (distance(i) < distance(middle))
        middle = i;
    return (std::abs(turns.x[middle] - turns.x[middle - 1]) + std::abs(turns.x[middle + 1] - turns.x[middle])) / 4;
  }
} // namespace myolines::study
