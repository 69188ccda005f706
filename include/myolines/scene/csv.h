// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace myolines::scene
{
  /// Comma-separated values (RFC 4180) under a line of names.
  struct CsvTable
  {
    std::filesystem::path                 file;       ///< where the table came from
    std::vector<std::string>              header;     ///< names of the columns
    std::vector<std::vector<std::string>> rows;       ///< each as long as the header
    std::vector<unsigned int>             lines;      ///< of the file that rows begin in, from 1
    std::optional<bool>                   in_degrees; ///< what the header of a file of OpenSim says of angles

    /// Index of the column with that name; nothing if there is none.
    std::optional<std::size_t> column(const std::string &name) const;
    /// The column that a person means by @p name: units in brackets and case count only where they decide between several.
    /// @throws InputError with the nearest name, or with those that may be meant.
    std::size_t required_column(const std::string &name) const;
    /// The finite numbers of a column. @throws InputError that names the line.
    std::vector<double> numbers(std::size_t column) const;
    /// "FILE, line 3"
    std::string where(std::size_t row) const;
  };

  /// A file that a program writes line by line: a last line that was not finished is left out. Nothing if there is no such file or a row
  /// has not as many fields as the header. @throws SystemError if the file is there and cannot be read.
  std::optional<CsvTable> read_csv(const std::filesystem::path &file);

  /// A file that a person gives: fields are separated by commas, semicolons or tabs, decimals by points or, where commas do not separate
  /// and no number has a point, by commas; lines that begin with # or % in front, "sep=;" of spreadsheets,
  /// OpenSim's headers, white space around fields, empty lines and separators at the ends of lines are left out. A line of units below the
  /// names becomes part of them: "time" above "ms" is "time [ms]". @throws InputError for what is no table.
  CsvTable read_csv_input(const std::filesystem::path &file);
} // namespace myolines::scene
