// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>

#include <string>
#include <vector>

namespace myolines::scene
{
  /// Adds to @p problems what the XML parser would tell in words that do not help, or not survive: a bare < or & in a value, and lists in
  /// lists beyond any use, @p file and the line in front. True if there was none.
  bool check_xml(const std::string &xml, const std::string &file, std::vector<InputProblem> &problems);
} // namespace myolines::scene
