// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  std::vector<Case> implicit_midpoint_cases()
  {
    Case c       = alpha_case("implicit_midpoint", {}, 0.5, 0.5, 0.25, 0.5);
    c.long_steps = false;
    return {c, suzuki_case("implicit_midpoint_suzuki")};
  }
} // namespace myolines::testing
