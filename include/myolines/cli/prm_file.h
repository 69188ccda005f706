// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myolines
{
  /// "set name = text" in a deal.II parameter file.
  struct PrmEntry
  {
    std::string  section;  ///< names of the subsections around it, separated by "/"
    std::string  name;     ///< between "set" and "="
    std::string  text;     ///< behind "="
    unsigned int line = 0; ///< of the file, from 1
  };

  /// Reads a deal.II parameter file (ParameterHandler): subsection/end, set, in small letters or capitals, comments from # on, lines
  /// continued by a backslash. @throws InputError with file and line for anything else, for an entry set twice and for unclosed
  /// subsections; without lines for a file of another kind, in which nothing is set.
  std::vector<PrmEntry> read_prm(const std::filesystem::path &file);

  /// A line of a table without header, as words.
  struct PrmRow
  {
    std::vector<std::string> words;    ///< in their order
    unsigned int             line = 0; ///< of the file, from 1
  };

  /// The lines of @p file as words separated by blanks or tabs; empty lines, and what follows a #, are left out.
  std::vector<PrmRow> read_rows(const std::filesystem::path &file);

  /// The lines of @p file that begin with a #, as words likewise, the # included.
  std::vector<PrmRow> read_comments(const std::filesystem::path &file);

  /// @throws InputError with file and line, and @p expected, unless @p row has @p n_words words, all but the first @p n_names of them
  /// finite numbers.
  void refuse_odd_row(const std::filesystem::path &file, const PrmRow &row, std::size_t n_names, std::size_t n_words,
                      const std::string &expected);
} // namespace myolines
