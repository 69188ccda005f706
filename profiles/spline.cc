// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/control_points.h>
#include <myolines/system/profiles.h>

namespace myolines
{
  ProfileEntry spline_profile()
  {
    return {"spline",
            {"points=0.1 0; 0.3 1; 0.55 0.6"},
            [](const std::string &, const std::string &unit) {
              return control_points_schema(unit, "The C2 spline through control points with slope zero at both ends, constant outside.");
            },
            [](const scene::Node &node, const Driven &) {
              return std::make_unique<PiecewiseDrive>(PiecewiseDrive::spline(read_control_points(node)));
            }};
  }
} // namespace myolines
