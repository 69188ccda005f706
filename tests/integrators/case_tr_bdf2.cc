// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  std::vector<Case> tr_bdf2_cases()
  {
    Case own       = second_order_l_stable_case("tr_bdf2_own_first_step");
    own.parameters = {"first step=own"};
    return {second_order_l_stable_case("tr_bdf2"), own};
  }
} // namespace myolines::testing
