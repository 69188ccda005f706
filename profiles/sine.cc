// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/drive_types.h>
#include <myolines/system/profiles.h>

namespace myolines
{
  namespace
  {
    scene::Schema sine_schema(const std::string &quantity, const std::string &unit)
    {
      scene::Schema schema("offset + A sin(2 pi f t + phase), thesis (4.7.5).");
      schema.number("amplitude", std::nullopt, unit, scene::Range::any(), "Amplitude A of the " + quantity + ".")
          .number("frequency", std::nullopt, "Hz", scene::Range::positive(), "Frequency f.")
          .number("phase", 0, "degree", scene::Range::any(), "Phase at time 0.")
          .number("offset", 0, unit, scene::Range::any(), "Mean value.");
      return schema;
    }
  } // namespace

  ProfileEntry sine_profile()
  {
    return {"sine", {"amplitude=0.5", "frequency=3", "phase=40", "offset=0.2"}, sine_schema, [](const scene::Node &node, const Driven &) {
              return std::make_unique<Sine>(node.number("amplitude"), node.number("frequency"),
                                            node.number("phase") * 3.14159265358979323846 / 180, node.number("offset"));
            }};
  }
} // namespace myolines
