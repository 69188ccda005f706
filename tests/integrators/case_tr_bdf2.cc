#include "cases.h"

namespace myolines::testing
{
  std::vector<Case> tr_bdf2_cases() { return {second_order_l_stable_case("tr_bdf2")}; }
} // namespace myolines::testing
