// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace myolines::scene
{
  /// The name of a column of a table: "length [mm]" or "length (mm)".
  struct ColumnName
  {
    std::string quantity; ///< "length"
    std::string unit;     ///< "mm"; "" where there is none
  };
  ColumnName split_column_name(const std::string &name); ///< Takes a name apart; what has no brackets is all quantity.

  /// @p text with the letters of ASCII in lower case.
  std::string lower_case(std::string text);

  /// Those of @p header that @p name means: equal to it, or else equal but for units in brackets, or else but for those and for case.
  std::vector<std::size_t> matching_columns(const std::string &name, const std::vector<std::string> &header);

  /// Whether @p name is a unit of time, length, speed, force, stress, voltage, angle or of ratios that is known.
  bool is_unit(const std::string &name);

  /// What a number in the unit @p from is multiplied by to be in @p to: 1e-3 for "mm" and "m". Units of time, length, speed, force,
  /// stress, voltage, angle and ratios ("-", "%"); others only where both are the same. Nothing if they do not fit.
  std::optional<double> unit_factor(const std::string &from, const std::string &to);
} // namespace myolines::scene
