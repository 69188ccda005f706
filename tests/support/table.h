// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "places.h"
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace myolines::testing
{
  using Row = std::vector<std::string>;

  /// The cells of tests/data/@p name, comma-separated, less the header; no cell is quoted there.
  inline std::vector<Row> rows(const std::string &name)
  {
    std::ifstream    file(myolines::test::source_folder() + "/tests/data/" + name);
    std::vector<Row> all;
    std::string      line;
    std::getline(file, line);
    while (std::getline(file, line))
      {
        std::istringstream cells(line);
        Row                row;
        for (std::string cell; std::getline(cells, cell, ',');)
          row.push_back(cell);
        all.push_back(row);
      }
    return all;
  }

  inline double number(const Row &row, const std::size_t column) { return std::stod(row.at(column)); }
} // namespace myolines::testing
