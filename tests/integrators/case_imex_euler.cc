// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  /// Of linear systems the tangent, and what is linear, are everything: what remains is backward Euler.
  std::vector<Case> imex_euler_cases()
  {
    std::vector<Case> all;
    for (const auto &[label, split] :
         {std::pair("imex_euler", "split=tangent at the start of the step"), std::pair("imex_euler_linear", "split=linear")})
      {
        Case c = runge_kutta_case(
            label, 1, [](std::complex<double> z) { return 1. / (1. - z); }, 0.5);
        c.parameters = {split};
        c.steps      = 1600;
        all.push_back(c);
      }
    return all;
  }
} // namespace myolines::testing
