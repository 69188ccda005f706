// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/numbers.h>
#include <myolines/system/drive_types.h>
#include <myolines/system/profiles.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    scene::Schema smooth_step_schema(const std::string &quantity, const std::string &unit)
    {
      scene::Schema schema("From 0 infinitely smoothly to the amplitude, thesis (4.7.3).");
      schema.number("amplitude", std::nullopt, unit, scene::Range::any(), "Amplitude A of the " + quantity + ".")
          .number("start", 0, "s", scene::Range::any(), "Time at which the step begins.")
          .number("duration", std::nullopt, "s", scene::Range::positive(), "Time T that the step takes.")
          .optional_number("maximum rate", "1/s", scene::Range::positive(),
                           "Greatest rate, at the middle, >= sqrt(3) |A| / T; absent: 2 |A| / T.");
      return schema;
    }

    /// The greatest rate sits in the middle, where the formula puts it, only for c0 <= 2/sqrt(3): rates from sqrt(3) |A| / T on.
    std::unique_ptr<Drive> make_smooth_step(const scene::Node &node, const Driven &)
    {
      const double amplitude = node.number("amplitude"), duration = node.number("duration");
      double       shape = 1;
      if (node.has("maximum rate"))
        {
          const double rate = node.number("maximum rate");
          shape             = 2 * std::abs(amplitude) / (rate * duration);
          if (shape > 2 / std::sqrt(3.))
            node.refuse("maximum rate", scene::format_number(rate) + " is too small for this amplitude and duration",
                        "at least sqrt(3) |amplitude| / duration = " +
                            scene::format_number(std::sqrt(3.) * std::abs(amplitude) / duration));
          if (amplitude == 0)
            shape = 1;
        }
      return std::make_unique<SmoothStep>(amplitude, node.number("start"), duration, shape);
    }
  } // namespace

  ProfileEntry smooth_step_profile()
  {
    return {"smooth step", {"amplitude=2", "start=0.1", "duration=0.5"}, smooth_step_schema, make_smooth_step};
  }
} // namespace myolines
