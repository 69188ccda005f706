// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace myolines::scene
{
  /// @p text without white space at its ends.
  std::string trimmed(const std::string &text);

  /// The lines of @p text, without their ends.
  std::vector<std::string> lines_of(const std::string &text);

  /// The finite number that @p text spells completely ("1e-3", "+2", " .5 "); nothing otherwise. Independent of the locale.
  std::optional<double> parse_number(const std::string &text);

  /// The integer that @p text spells completely; nothing otherwise.
  std::optional<int> parse_integer(const std::string &text);

  /// Shortest decimal text that parse_number() turns back into exactly @p value.
  std::string format_number(double value);
} // namespace myolines::scene
