// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/drive_types.h>
#include <myolines/system/profiles.h>

namespace myolines
{
  namespace
  {
    scene::Schema power_schema(const std::string &, const std::string &unit)
    {
      scene::Schema schema("A (t - t0)^n from t0 on, 0 before.");
      schema.number("amplitude", std::nullopt, unit + "/s^n", scene::Range::any(), "Factor A.")
          .number("start", 0, "s", scene::Range::any(), "Time t0.")
          .integer("exponent", std::nullopt, scene::Range::closed(1, 9), "Exponent n; there is a kink at t0 for n = 1 and 2.");
      return schema;
    }
  } // namespace

  ProfileEntry power_profile()
  {
    return {"power", {"amplitude=2", "start=0.1", "exponent=2"}, power_schema, [](const scene::Node &node, const Driven &) {
              return std::make_unique<Power>(node.number("amplitude"), node.number("start"), node.integer("exponent"));
            }};
  }
} // namespace myolines
