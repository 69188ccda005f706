// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study.h"
#include "../support/places.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace myolines::testing
{
  std::vector<StudyEntry> study(const unsigned int refinement, const std::string &scheme)
  {
    const std::string file = myolines::test::source_folder() + "/tests/data/integrators_3d.csv";
    std::ifstream     stream(file);
    if (!stream)
      throw std::runtime_error(file + " cannot be read");
    std::vector<StudyEntry> entries;
    const std::string       begin = std::to_string(refinement) + "," + scheme + ",";
    for (std::string line; std::getline(stream, line);)
      if (line.rfind(begin, 0) == 0)
        {
          std::istringstream       cells(line.substr(begin.size()));
          std::vector<std::string> cell(4);
          for (std::string &text : cell)
            std::getline(cells, text, ',');
          StudyEntry entry{static_cast<unsigned int>(std::stoul(cell[0])), std::stod(cell[1]), {}, std::stod(cell[3])};
          if (!cell[2].empty())
            entry.velocity_error = std::stod(cell[2]);
          entries.push_back(entry);
        }
    if (entries.empty())
      throw std::runtime_error(file + " has no row " + begin);
    return entries;
  }

  unsigned int steps_of_reference(const unsigned int refinement) { return refinement == 1 ? 512 : 256; }

  bool same_digits(const double x, const double printed)
  {
    const double unit = std::pow(10., std::floor(std::log10(printed)) - 1);
    return std::abs(x - printed) < 1.5 * unit;
  }
} // namespace myolines::testing
