// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>

namespace myolines
{
  /// "1 step", "3 steps": a number of things whose plural ends with s.
  inline std::string counted(const std::size_t n, const std::string &thing)
  {
    return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
  }
} // namespace myolines
