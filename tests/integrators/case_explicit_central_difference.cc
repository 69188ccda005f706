// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  /// Without damping Newmark's method with beta = 0. With damping the rates are met at the predicted velocity v_0 + dt a_0.
  std::vector<Case> explicit_central_difference_cases()
  {
    Case c              = alpha_case("explicit_central_difference", {}, 0, 0, 0, 0.5);
    c.highest_frequency = 1;
    c.long_steps        = false;
    c.polynomial        = [](const double w, const double xi) {
      const double x = 2 * xi * w, k = w * w;
      return from_pencil({{1, 0, 0}, {0, 1, -0.5}, {k, 0, 1}}, {{1, 1, 0.5}, {0, 1, 0.5}, {0, -x, -x}});
    };
    return {c};
  }
} // namespace myolines::testing
