// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "page.h"

namespace myolines::report
{
  /// At most @p most points of @p curve: the lowest and the highest of each of so many equal parts, and the ends.
  study::Curve thinned(const study::Curve &curve, std::size_t most);

  /// The picture with thinned curves, or its panels.
  study::Picture thinned(study::Picture picture);

  /// What the script draws: one for a picture, or one for each panel.
  std::vector<Json> charts_of(const study::Picture &picture);

  /// Pictures with their static drawings, which gnuplot makes, in their order. Those without points are left out.
  std::vector<std::pair<study::Picture, std::string>> drawn(std::vector<study::Picture> pictures);
} // namespace myolines::report
