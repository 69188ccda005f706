// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace myolines
{
  /// @p text for XML and HTML, in elements and in attributes with quotes of either kind: markup is letters, bytes that are no UTF-8 and
  /// control characters that XML does not allow are U+FFFD.
  std::string escaped(const std::string &text);
} // namespace myolines
