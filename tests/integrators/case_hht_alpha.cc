// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  std::vector<Case> hht_alpha_cases()
  {
    const auto hht = [](const std::string &label, const double alpha, const std::string &force) {
      Case c = alpha_case("hht_alpha_" + label, {setting("alpha", alpha), "force evaluation=" + force}, 0, -alpha,
                          (1 - alpha) * (1 - alpha) / 4, 0.5 - alpha);
      if (force == "weighted end forces")
        c.history = {{"force at the last step", 2}};
      return c;
    };
    Case own = hht("own_first_step", -0.3, "weighted end forces");
    own.parameters.push_back("first step=own");
    return {hht("default", -0.1, "weighted end forces"), hht("strong", -0.3, "weighted end forces"),
            hht("averaged", -0.3, "averaged state"), own};
  }
} // namespace myolines::testing
