// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  /// That of the implicit midpoint rule: linear systems do not tell them apart.
  std::vector<Case> energy_momentum_cases()
  {
    Case c       = alpha_case("energy_momentum", {}, 0.5, 0.5, 0.25, 0.5);
    c.long_steps = false;
    return {c, suzuki_case("energy_momentum_suzuki")};
  }
} // namespace myolines::testing
