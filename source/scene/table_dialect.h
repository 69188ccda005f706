// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace myolines::scene
{
  /// The table in a text file, from its line of names on.
  struct TableText
  {
    std::string  text;
    unsigned int line      = 1;   ///< of the names in the file
    char         separator = ','; ///< comma, semicolon or tab

    std::optional<int>  rows, columns; ///< that the header of a file of OpenSim announces, times among the columns
    std::optional<bool> in_degrees;    ///< "inDegrees=yes" or "no" there
  };

  /// The table in @p text: without blank and comment lines (#, %) in front, and without the header of OpenSim's files, which ends with the
  /// line "endheader" and may announce the size of the table; their blanks become tabs. The separator is that of the names; where they hold
  /// several, that one which cuts the first line of values into as many fields as the names, each of them a number or without another
  /// separator. @throws InputError where that is none or more than one.
  TableText find_table(const std::string &text, const std::filesystem::path &file);

  /// "0,5" or "-1,5e-3" with a point for the comma; nothing for other cells.
  std::optional<std::string> with_decimal_point(std::string cell);
} // namespace myolines::scene
