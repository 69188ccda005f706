// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/study.h>

namespace myolines::study
{
  /// Declaration of one axis.
  scene::Schema axis_schema();

  /// How many points the axis has, without making them.
  double number_of_points(const scene::Node &node);

  /// What a validated axis means. @throws InputError, for example for an axis without points.
  Axis read_axis(const scene::Node &node);
} // namespace myolines::study
