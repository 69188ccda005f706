#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myolines
{
  /// "set name = text" in a deal.II parameter file.
  struct PrmEntry
  {
    std::string  section; ///< names of the subsections around it, separated by "/"
    std::string  name;
    std::string  text;
    unsigned int line = 0;
  };

  /// Reads a deal.II parameter file (ParameterHandler): subsection/end, set, comments from # on, lines continued by a
  /// backslash. @throws InputError with file and line for anything else, for an entry set twice and for unclosed subsections.
  std::vector<PrmEntry> read_prm(const std::filesystem::path &file);

  /// The lines of @p file as words separated by blanks, @p n_words each; all but the first @p n_names of them numbers. Empty lines, and what
  /// follows a #, are left out. @throws InputError with file and line, and @p expected.
  std::vector<std::string> read_rows(const std::filesystem::path &file, unsigned int n_names, unsigned int n_words,
                                     const std::string &expected);
} // namespace myolines
