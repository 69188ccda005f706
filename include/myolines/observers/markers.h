// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/measures/marker_probe.h>
#include <myolines/muscle3d/body_measures.h>
#include <myolines/scene/scene.h>

#include <string>
#include <vector>

namespace myolines
{
  /// Adds the parameters `markers` and `markers file` to the list @p series.
  void add_marker_parameters(scene::Schema &series);

  /// The markers of @p series: "name x y z" each [m, reference], separated by ";" in `markers`, by lines in
  /// `markers file` (Flexodeal's format; "#" starts a comment). Empty without either.
  /// @throws InputError for a malformed or repeated marker, or if both parameters are written.
  std::vector<Marker> read_markers(const scene::Node &series);

  /// Where the markers came from, for messages.
  std::string markers_origin(const scene::Node &series);
} // namespace myolines
