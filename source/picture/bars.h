// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/picture/figure.h>

#include <map>

namespace myolines::picture
{
  /// The map that suits a field with values in a range.
  ColourMap map_for(const std::string &field, const std::pair<double, double> &range);

  /// The range as it is drawn: symmetric about 0 for the diverging map, never empty.
  std::pair<double, double> drawn_range(const std::string &field, const std::pair<double, double> &range);

  /// 1, 2 or 5 times a power of ten, the largest that is at most @p x > 0.
  double round_length(double x);

  /// "20 mm", of a length [m].
  std::string length_text(double length);

  /// The colour bar of @p field with the corner (x, y), so wide and high [px], with numbers to its right and the name above.
  void add_colour_bar(const std::string &field, const std::pair<double, double> &range, double x, double y, double width, double height,
                      Sheet &sheet);

  /// What stands in its place for tissues: a box and a name for each number of @p tissues.
  void add_tissue_key(const std::map<int, std::string> &tissues, double x, double y, double width, Sheet &sheet);
} // namespace myolines::picture
