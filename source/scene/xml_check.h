// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>

#include <optional>
#include <string>
#include <vector>

namespace myolines::scene
{
  /// Whether no text of XML may have @p c: control characters but for tabs and ends of lines.
  inline bool is_control(const char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r'; }

  /// @p xml as the XML parser takes it: blanks, on the same lines, for the declaration, comments with any characters, processing
  /// instructions and a document type, of which nothing is read; UTF-8 for references to characters beyond ASCII. Nothing, and the first
  /// problem in @p problems with @p file and the line, for what the parser would tell in words that do not help, or not survive: a bare <
  /// or & or an unknown entity in a value, control characters, CDATA sections, comments and values without end, and lists in lists beyond
  /// any use.
  std::optional<std::string> plain_xml(const std::string &xml, const std::string &file, std::vector<InputProblem> &problems);
} // namespace myolines::scene
