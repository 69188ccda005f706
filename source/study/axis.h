#pragma once

#include <myolines/study/study.h>

namespace myolines::study
{
  /// Declaration of one axis.
  scene::Schema axis_schema();

  /// What a validated axis means. @throws InputError, for example for an axis without points.
  Axis read_axis(const scene::Node &node);
} // namespace myolines::study
