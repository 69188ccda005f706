// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/control_points.h>
#include <myolines/system/profiles.h>

namespace myolines
{
  ProfileEntry control_points_profile()
  {
    return {"control points",
            {"points=0.1 0; 0.3 1; 0.55 0.6"},
            [](const std::string &, const std::string &unit) {
              return control_points_schema(unit, "Straight lines between control points, constant before the first and after the last.");
            },
            [](const scene::Node &node, const Driven &) {
              return std::make_unique<PiecewiseDrive>(PiecewiseDrive::lines(read_control_points(node)));
            }};
  }
} // namespace myolines
