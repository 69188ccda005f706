// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

#include <cmath>

namespace myolines::testing
{
  /// R(z) = P(z)/(1 - g z)^3 with the P of degree two that makes it agree with e^z up to z^3; the next term is the error.
  std::vector<Case> sdirk3_cases()
  {
    const double g         = 0.435866521508459;
    const auto   stability = [g](std::complex<double> z) {
      return (1. + (1 - 3 * g) * z + (0.5 - 3 * g + 3 * g * g) * z * z) / std::pow(1. - g * z, 3);
    };
    const double g2 = g * g;
    Case c = runge_kutta_case("sdirk3", 3, stability, 15 * g2 * g2 + 10 * g2 * g * (1 - 3 * g) + 6 * g2 * (0.5 - 3 * g + 3 * g2) - 1. / 24);
    c.steps = 40;
    // g/5 times the second difference of the stages' derivatives; their third derivatives have the coefficients c and (A c) of the stages
    c.estimate = g / 5 * std::abs(g2 - 2 * g + 0.5);
    return {c};
  }
} // namespace myolines::testing
