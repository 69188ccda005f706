// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cases.h>

#include <cmath>

namespace myolines::testing
{
  /// The two parts one after the other for u' = lambda u: the trapezoidal rule over g dt, then weights of all slopes.
  std::vector<Case> rho_bathe_cases()
  {
    const auto with = [](const std::string &label, const double rho, Overrides parameters) {
      // as published: g of equation (31), then the weights of (27)
      const double g = rho == 1 ? 0.5 : (2 - std::sqrt(2 + 2 * rho)) / (1 - rho), q1 = (rho + 1) / (2 * g * (rho - 1) + 4);
      const double q0 = (g - 1) * q1 + 0.5, q2 = 0.5 - g * q1;
      const auto   stability = [=](std::complex<double> z) {
        const std::complex<double> between = (1. + g / 2 * z) / (1. - g / 2 * z);
        return (1. + q0 * z + q1 * z * between) / (1. - q2 * z);
      };
      const double third = q2 * q2 * q2 + (q0 + q1) * q2 * q2 + q1 * g * q2 + q1 * g * g / 2; // of the powers of z in it
      Case         c     = runge_kutta_case(label, 2, stability, third - 1. / 6);
      c.parameters       = std::move(parameters);
      return c;
    };
    return {with("bathe", 0.5, {}), with("bathe_own_first_step", 0.5, {"first step=own"}), with("bathe_0", 0, {"spectral radius=0"}),
            with("bathe_1", 1, {"spectral radius=1"})};
  }
} // namespace myolines::testing
