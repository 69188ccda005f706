// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/profiles.h>
#include <myolines/system/steered_drive.h>

namespace myolines
{
  ProfileEntry steered_profile()
  {
    return {"steered", {"value=0.3"}, steered_schema, [](const scene::Node &node, const Driven &driven) {
              return make_steered_drive(node, driven);
            }};
  }
} // namespace myolines
