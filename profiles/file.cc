// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/profiles.h>

namespace myolines
{
  ProfileEntry file_profile()
  {
    return {"file",
            {"file=samples.csv"},
            [](const std::string &, const std::string &unit) { return file_profile_schema(unit); },
            [](const scene::Node &node, const Driven &driven) { return make_file_drive(node, driven); }};
  }
} // namespace myolines
