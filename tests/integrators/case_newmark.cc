// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  std::vector<Case> newmark_cases()
  {
    const auto preset = [](const std::string &name, const double beta) {
      std::string label = "newmark_" + name;
      for (char &letter : label)
        letter = letter == ' ' ? '_' : letter;
      Case c         = alpha_case(label, {"preset=" + name}, 0, 0, beta, 0.5);
      c.scheme_rates = beta == 0.25 || beta == 0;
      return c;
    };
    std::vector<Case> cases    = {preset("average acceleration", 0.25),
                                  preset("linear acceleration", 1. / 6),
                                  preset("fox goodwin", 1. / 12),
                                  preset("central difference", 0),
                                  alpha_case("newmark_own_first_step", {"preset=average acceleration", "first step=own"}, 0, 0, 0.25, 0.5),
                                  alpha_case("newmark_own_first_order", {"preset=own", "beta=0.3025", "gamma=0.6"}, 0, 0, 0.3025, 0.6)};
    cases[3].highest_frequency = 10; // far beyond 2, where entries of the step grow like w^2
    // Numerov's formula: without rates and with third derivative 0 at the start the displacement is of fourth order
    cases[2].long_steps = cases[3].long_steps = false;
    cases[1].controls_error                   = false; // beta = 1/6 leaves nothing to estimate
    cases[2].other_orders                     = {{"autonomous", {4, 2}}, {"cubic spring", {4, 2}}};
    return cases;
  }
} // namespace myolines::testing
