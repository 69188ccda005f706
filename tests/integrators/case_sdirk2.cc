#include "cases.h"

namespace myolines::testing
{
  std::vector<Case> sdirk2_cases() { return {second_order_l_stable_case("sdirk2")}; }
} // namespace myolines::testing
