// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace myolines
{
  /// The entry of @p candidates with the smallest edit distance to @p name, or "" if none is near
  /// (more than half of the name would have to change).
  std::string nearest_name(const std::string &name, const std::vector<std::string> &candidates);

  /// The hint "nearest: "b"" of a message, with other words before the colon if @p label says so, or "" if none is near.
  std::string nearest_hint(const std::string &name, const std::vector<std::string> &candidates, const std::string &label = "nearest");

  /// "a, b, c".
  std::string join(const std::vector<std::string> &words, const std::string &separator = ", ");

  /// A command as a shell would read it: words with blanks or special characters in quotes.
  std::string shell_text(const std::vector<std::string> &words);
} // namespace myolines
