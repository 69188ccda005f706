// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/instants.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines
{
  double time_tolerance(const double t, const double size)
  {
    return std::max(1e-9 * size, 4 * std::numeric_limits<double>::epsilon() * std::abs(t));
  }

  bool same_time(const double one, const double other, const double size)
  {
    const double apart = std::abs(one - other);
    return std::isfinite(apart) && apart <= time_tolerance(std::max(std::abs(one), std::abs(other)), size);
  }

  bool has_begun(const double begin, const double t, const Side side, const double tolerance)
  {
    return side == Side::right ? t >= begin - tolerance : t > begin + tolerance;
  }

  std::vector<double> one_list(std::vector<double> times)
  {
    std::sort(times.begin(), times.end());
    std::vector<double> all;
    for (const double t : times)
      if (!all.empty() && same_time(all.back(), t))
        all.back() = t;
      else
        all.push_back(t);
    return all;
  }
} // namespace myolines
