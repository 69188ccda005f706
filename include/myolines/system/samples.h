// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myolines
{
  /// Where samples of a quantity stand in a table.
  struct SampleColumn
  {
    std::filesystem::path file;  ///< the table
    std::string           time;  ///< name of the column of times; "": "time" or "t"
    std::string           value; ///< name of the column of values; "": the only one beside the times
    std::string           unit;  ///< of the values where their name has none; "": the one that is wanted
  };

  /// Samples at ascending times, evenly spaced or not.
  struct Samples
  {
    std::vector<double> t; ///< [s], at least two, strictly ascending
    std::vector<double> x; ///< in the unit that was asked for
  };

  /// The samples in @p column, times in seconds and values in @p unit, or as they are where it is "". Units are those in the brackets of
  /// the names; times without are seconds. @throws InputError that names file, line and column for what is no table, a column that is not
  /// there (with the nearest one), units that do not fit, what is no number, and times that do not ascend.
  Samples read_samples(const SampleColumn &column, const std::string &unit);
} // namespace myolines
