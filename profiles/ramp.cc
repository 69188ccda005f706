// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/numbers.h>
#include <myolines/system/drive_types.h>
#include <myolines/system/profiles.h>

namespace myolines
{
  namespace
  {
    scene::Schema ramp_schema(const std::string &quantity, const std::string &unit)
    {
      scene::Schema schema("From 0 linearly to the amplitude, then constant, thesis (4.7.4); kinks at both ends.");
      schema.number("amplitude", std::nullopt, unit, scene::Range::any(), "Amplitude A of the " + quantity + ".")
          .number("start", 0, "s", scene::Range::any(), "Time at which the ramp begins.")
          .number("duration", std::nullopt, "s", scene::Range::positive(), "Time that the ramp takes.");
      return schema;
    }

    std::unique_ptr<Drive> make_ramp(const scene::Node &node, const Driven &)
    {
      const double                                    start = node.number("start"), duration = node.number("duration");
      const std::vector<PiecewiseDrive::ControlPoint> points{{start, 0}, {start + duration, node.number("amplitude")}};
      if (!(duration > 4 * PiecewiseDrive::tolerance(points)))
        node.refuse("duration", scene::format_number(duration) + " s vanishes beside the start at " + scene::format_number(start) + " s",
                    "a longer time");
      return std::make_unique<PiecewiseDrive>(PiecewiseDrive::lines(points));
    }
  } // namespace

  ProfileEntry ramp_profile() { return {"ramp", {"amplitude=2", "start=0.1", "duration=0.5"}, ramp_schema, make_ramp}; }
} // namespace myolines
