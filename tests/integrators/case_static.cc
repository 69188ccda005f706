// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

namespace myolines::testing
{
  /// No dynamics; see the tests named Static in contract.cc.
  std::vector<Case> static_cases() { return {}; }
} // namespace myolines::testing
