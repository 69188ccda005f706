// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/semi_discrete_system.h>

#include <numeric>

namespace myolines
{
  std::vector<unsigned int> SemiDiscreteSystem::canonical_order() const
  {
    std::vector<unsigned int> order(initial_state(0).u.locally_owned_size());
    std::iota(order.begin(), order.end(), 0u);
    return order;
  }
} // namespace myolines
