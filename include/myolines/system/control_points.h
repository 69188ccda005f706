// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/system/drive_types.h>

#include <string>
#include <vector>

namespace myolines
{
  /// Parameters of a profile through control points, which stand in the scene (`points`) or in a file, in @p unit; @p doc says what is
  /// between them.
  scene::Schema control_points_schema(const std::string &unit, const std::string &doc);

  /// Reads them, times the scale of their values. @throws InputError for what is no number, for times that do not ascend, and for none.
  std::vector<PiecewiseDrive::ControlPoint> read_control_points(const scene::Node &node);
} // namespace myolines
