// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/measures.h>

#include <filesystem>
#include <optional>
#include <string>

namespace myolines::study
{
  /// A number that is read off a column of a time series.
  struct VerifiedQuantity
  {
    enum class Take
    {
      last,
      largest,
      smallest,
      at ///< linear between rows
    };
    std::string text;         ///< as it was given
    std::string file, column; ///< the column by its header, or without unit
    Take        take = Take::last;
    double      time = 0; ///< [s]
  };

  /// The largest or smallest value of the column, at whatever time.
  inline bool is_extreme(const VerifiedQuantity &quantity)
  {
    return quantity.take == VerifiedQuantity::Take::largest || quantity.take == VerifiedQuantity::Take::smallest;
  }

  /// "FILE:COLUMN", with ":last", ":largest", ":smallest" or ":at TIME" after it. @throws InputError.
  VerifiedQuantity read_verified_quantity(const std::string &text);

  /// A value with the header of its column.
  struct NamedValue
  {
    std::string header; ///< "moving end x [N]"
    double      value;
    double      time;        ///< of the value [s]
    double      between = 0; ///< how far a smooth curve through the rows may go beyond an extreme one: h^2 |x''| / 8
  };

  /// The value in the run in @p folder. @throws InputError with the nearest names if the run does not have it.
  NamedValue value_in_run(const VerifiedQuantity &quantity, const std::filesystem::path &folder);

  /// The rows of the column in the run in @p folder that have a number. @throws InputError as value_in_run() does.
  Series series_in_run(const VerifiedQuantity &quantity, const std::filesystem::path &folder);

  /// "last", "at 0.1 s".
  std::string words_of(const VerifiedQuantity &quantity);
} // namespace myolines::study
