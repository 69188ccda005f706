// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  std::vector<Case> generalized_alpha_cases()
  {
    const auto from = [](const std::string &label, const Overrides &parameters, const double radius) {
      const double m = (2 * radius - 1) / (radius + 1), f = radius / (radius + 1), x = 1 - m + f;
      Case         c = alpha_case("generalized_alpha_" + label, parameters, m, f, x * x / 4, 0.5 - m + f);
      if (label != "half_averaged_state" && radius > 0)
        c.history = {{"force at the last step", 2}};
      c.long_steps = radius < 1;
      return c;
    };
    const std::string radius = "spectral radius at infinity=", averaged = "force evaluation=averaged state";
    return {from("default", {}, 0.8),
            from("half", {"given by=spectral radius", radius + "0.5"}, 0.5),
            from("half_averaged_state", {radius + "0.5", averaged}, 0.5),
            from("annihilating", {radius + "0"}, 0),
            from("conserving", {radius + "1"}, 1),
            from("coefficients_chung_hulbert", {"given by=coefficients", "alpha m=0", "alpha f=0.3333333333333333"}, 0.5),
            from("coefficients_jansen_whiting_hulbert",
                 {"given by=coefficients", "alpha m=1", "alpha f=0.6666666666666667", "convention=jansen whiting hulbert"}, 0.5)};
  }
} // namespace myolines::testing
