// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  std::vector<Case> wbz_alpha_cases()
  {
    const auto wbz = [](const std::string &label, const double alpha) {
      return alpha_case("wbz_alpha_" + label, {setting("alpha", alpha)}, alpha, 0, (1 - alpha) * (1 - alpha) / 4, 0.5 - alpha);
    };
    Case own = wbz("own_first_step", -0.1);
    own.parameters.push_back("first step=own");
    return {wbz("default", -0.1), wbz("strong", -0.5), own};
  }
} // namespace myolines::testing
