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
} // namespace myolines
