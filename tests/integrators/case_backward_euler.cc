// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  std::vector<Case> backward_euler_cases()
  {
    Case c = runge_kutta_case(
        "backward_euler", 1, [](std::complex<double> z) { return 1. / (1. - z); }, 0.5);
    c.steps = 1600;
    return {c};
  }
} // namespace myolines::testing
