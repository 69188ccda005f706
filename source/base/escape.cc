// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/escape.h>
#include <myolines/base/files.h>

namespace myolines
{
  std::string escaped(const std::string &text)
  {
    const char *const replacement = "\xEF\xBF\xBD";
    std::string       safe, rest = text;
    for (std::size_t bad = first_not_utf8(rest); bad != std::string::npos; bad = first_not_utf8(rest))
      rest.replace(bad, 1, replacement);
    for (const char c : rest)
      if (c == '&')
        safe += "&amp;";
      else if (c == '<')
        safe += "&lt;";
      else if (c == '>')
        safe += "&gt;";
      else if (c == '"')
        safe += "&quot;";
      else if (c == '\'')
        safe += "&#39;";
      else if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
        safe += replacement;
      else
        safe += c;
    return safe;
  }
} // namespace myolines
