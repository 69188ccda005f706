// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  /// Linear systems that do not turn cannot tell it from the theta method, theta = (1 + chi)/2: R(z) = (1 + (1 - theta) z)/(1 - theta z).
  std::vector<Case> dissipative_energy_momentum_cases()
  {
    const auto from = [](const std::string &label, const Overrides &parameters, const double radius) {
      const double chi = (1 - radius) / (1 + radius), theta = (1 + chi) / 2;
      Case         c = runge_kutta_case(
                  "dissipative_energy_momentum_" + label, 1,
                  [theta](const std::complex<double> z) { return (1. + (1 - theta) * z) / (1. - theta * z); }, chi / 2);
      c.parameters = parameters;
      c.steps      = 1600;
      return c;
    };
    const std::string radius = "spectral radius at infinity=";
    return {from("default", {}, 0.8), from("half", {radius + "0.5"}, 0.5), from("annihilating", {radius + "0"}, 0)};
  }
} // namespace myolines::testing
