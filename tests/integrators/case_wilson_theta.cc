// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

#include <cmath>

namespace myolines::testing
{
  namespace
  {
    /// (u, dt v, dt^2 a): linear acceleration, and a + 2 xi w v + w^2 u = 0 at t_0 + theta dt.
    Case wilson_case(const std::string &label, const double theta, const std::string &first_step = "l-stable")
    {
      Case c;
      c.label        = "wilson_theta_" + label;
      c.parameters   = {setting("theta", theta), "first step=" + first_step};
      c.order        = 2;
      c.scheme_rates = false;
      c.steps        = first_step == "own" ? 100 : 400; // the error of the first step, of third order, has the other sign
      // a at the end of a step is wrong by theta (theta - 1)/2 dt^2 a'', and the next step, whole or half, begins with it
      c.estimate_is_asymptotic = false;
      c.polynomial             = [theta](const double w, const double xi) {
        const double x = 2 * xi * w, k = w * w, q = theta;
        return from_pencil(
                        {{1, 0, -1. / 6}, {0, 1, -0.5}, {0, 0, q + x * q * q / 2 + k * q * q * q / 6}},
                        {{1, 1, 1. / 3}, {0, 1, 0.5}, {-k, -x - k * q, -(1 - q) - x * (q - q * q / 2) - k * (q * q / 2 - q * q * q / 6)}});
      };
      c.starting_steps   = 2;
      const double kappa = (1. / 12 + theta * (theta - 1) / 2) / 2;
      c.error = [kappa](const double T) { return Motion{kappa * T * std::sin(T), kappa * T * std::cos(T) + kappa * std::sin(T)}; };
      return c;
    }
  } // namespace

  std::vector<Case> wilson_theta_cases()
  {
    return {wilson_case("default", 1.4), wilson_case("long", 1.8), wilson_case("own_first_step", 1.4, "own")};
  }
} // namespace myolines::testing
