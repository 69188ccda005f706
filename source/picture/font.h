// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

namespace myolines::picture
{
  /// Lines that draw a text whose base line begins at (0, 0), in units of which six are the height of a capital; y upwards. A letter that
  /// the font does not have is a box.
  struct WrittenText
  {
    std::vector<std::array<double, 4>> lines; ///< from x, y to x, y
    double                             width = 0;
  };

  WrittenText written(const std::string &utf8);
} // namespace myolines::picture
