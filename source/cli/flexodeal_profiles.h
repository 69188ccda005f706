// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "flexodeal_parameters.h"

#include <myolines/scene/schema.h>

#include <filesystem>
#include <string>
#include <vector>

namespace myolines
{
  /// A function of time by control points, as the scene has them.
  struct FlexodealProfile
  {
    std::string points; ///< "t value; t value"
    std::string origin; ///< the file, or the entry, that it is from
  };

  /// Control points from a file of two columns: constant before the first and after the last. @throws InputError with file and line of what
  /// is no control point, of times that do not ascend and of a @p quantity outside @p range.
  FlexodealProfile read_control_points(const std::filesystem::path &file, const std::string &quantity, const scene::Range &range);

  /// The ramp of the earliest versions: "Pull strain" of @p length [m], at "Pull strain rate" [m/s], in the middle between "Pull time
  /// start" and "Pull time end". @throws InputError if it does not fit in between.
  FlexodealProfile strain_ramp(FlexodealParameters &theirs, double length);

  /// The ramp of the earliest versions, to "Activation level" [%] from "Activation start" to "Activation end".
  FlexodealProfile activation_ramp(FlexodealParameters &theirs);

  /// A column of a file of pressures.
  struct FlexodealPressure
  {
    int         face; ///< boundary id
    std::string points;
    std::string origin; ///< the line of names
  };

  /// Pressures on faces: a line of names, the first of time and the others boundary ids, above lines of as many numbers. The line may be a
  /// comment, as in newer versions. Positive ones pull. @throws InputError with file and line.
  std::vector<FlexodealPressure> read_pressures(const std::filesystem::path &file);

  /// A point whose displacement is written.
  struct FlexodealMarker
  {
    std::string name, position; ///< "x y z"
    std::string origin;
  };

  /// The points of @p file, which may be empty, and the three that older versions have among their parameters: left, mid and right.
  std::vector<FlexodealMarker> read_flexodeal_markers(const std::filesystem::path &file, FlexodealParameters &theirs);
} // namespace myolines
