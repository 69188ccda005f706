// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cases.h>

#include <cmath>

namespace myolines::testing
{
  /// 2 u_1 - 5 u_0 + 4 u_-1 - u_-2 + 2 xi w (11 u_1 - 18 u_0 + 9 u_-1 - 2 u_-2)/6 + w^2 u_1 = 0. The formula of the acceleration gives
  /// u'' - 11/12 dt^2 u'''', that of the velocity is of third order.
  std::vector<Case> houbolt_cases()
  {
    Case c;
    c.label          = "houbolt";
    c.order          = 2;
    c.history        = {{"u before the last step", 0}, {"u before that", 0}};
    c.starting_steps = 2;
    c.steps          = 400; // terms of the next order are large
    c.controls_error = false;
    c.polynomial     = [](const double w, const double xi) {
      const double x = xi * w / 3, leading = 2 + 11 * x + w * w;
      return Polynomial{(-5 - 18 * x) / leading, (4 + 9 * x) / leading, (-1 - 2 * x) / leading};
    };
    c.error = [](const double T) { return Motion{11. / 24 * T * std::sin(T), 11. / 24 * (T * std::cos(T) + std::sin(T))}; };
    return {c};
  }
} // namespace myolines::testing
