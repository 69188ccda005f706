// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/profiles.h>

namespace myolines
{
#define MYOLINES_PROFILE(name) ProfileEntry name##_profile();
#include "../../profiles/list.def"
#undef MYOLINES_PROFILE

  Registry<ProfileEntry> &profile_registry()
  {
    static Registry<ProfileEntry> registry("profile", {
#define MYOLINES_PROFILE(name) name##_profile(),
#include "../../profiles/list.def"
#undef MYOLINES_PROFILE
                                                      });
    return registry;
  }

  scene::Schema drive_schema(const std::string &quantity, const std::string &unit)
  {
    std::vector<std::pair<std::string, scene::Schema>> kinds;
    for (const ProfileEntry &entry : profile_registry())
      kinds.emplace_back(entry.name, entry.schema(quantity, unit));
    scene::Schema schema("The " + quantity + " as a function of time.");
    schema.variant("type", profile_registry()[0].name, kinds, "How the " + quantity + " varies.");
    return schema;
  }

  std::unique_ptr<Drive> make_drive(const scene::Node &node) { return make_drive(node, Driven()); }

  std::unique_ptr<Drive> make_drive(const scene::Node &node, const Driven &driven)
  {
    return profile_registry().find(node.text("type"))->make(node, driven); // a scene has no other types
  }
} // namespace myolines
