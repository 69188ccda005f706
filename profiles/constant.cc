// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/drive_types.h>
#include <myolines/system/profiles.h>

namespace myolines
{
  ProfileEntry constant_profile()
  {
    return {"constant",
            {"value=0.3"},
            [](const std::string &quantity, const std::string &unit) {
              scene::Schema schema("The same at all times.");
              schema.number("value", 0, unit, scene::Range::any(), "Value of the " + quantity + ".");
              return schema;
            },
            [](const scene::Node &node, const Driven &) {
              return std::make_unique<PiecewiseDrive>(PiecewiseDrive::constant(node.number("value")));
            }};
  }
} // namespace myolines
