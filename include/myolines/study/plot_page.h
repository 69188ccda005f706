// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/picture.h>

#include <string>
#include <vector>

namespace myolines::study
{
  /// A curve that stays at one value.
  struct Constant
  {
    std::string title; ///< "reaction: fixed end z [N]"
    double      value; ///< in the unit of the column
  };

  /// Takes pictures away in which no curve changes, up to rounding (1e-12 of the largest value), and tells their values.
  std::vector<Constant> without_constants(std::vector<Picture> &pictures);

  /// A page that shows @p pictures, whose SVG files lie beside it, with their titles, and the values that no picture shows. All texts are
  /// escaped.
  std::string index_page(const std::string &title, const std::vector<Picture> &pictures, const std::vector<Constant> &constants);
} // namespace myolines::study
