// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

#include <cmath>

namespace myolines::testing
{
  /// The embedded formula is u_0 + dt v_1 with v_1 at t_0 + g dt, its difference g (1 - g) dt^2 u'', the estimate a fifth of it.
  std::vector<Case> sdirk2_cases()
  {
    const double g = 1 - 1 / std::sqrt(2.);
    Case         c = second_order_l_stable_case("sdirk2");
    c.estimate     = g * (1 - g) / 5;
    return {c};
  }
} // namespace myolines::testing
