// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  std::vector<Case> rosenbrock_cases() { return {second_order_l_stable_case("rosenbrock")}; }
} // namespace myolines::testing
