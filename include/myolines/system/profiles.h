// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/registry.h>
#include <myolines/system/file_drive.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// A kind of given function of time: what its file in `profiles/` gives to the list of all.
  struct ProfileEntry
  {
    std::string              name;    ///< `type` in a scene
    std::vector<std::string> example; ///< "duration=0.5": with them there is one that is not zero within the first second

    /// Of its parameters, beside the type; @p quantity and @p unit name what is driven ("boundary strain", "-").
    std::function<scene::Schema(const std::string &quantity, const std::string &unit)> schema;

    std::function<std::unique_ptr<Drive>(const scene::Node &, const Driven &)> make; ///< of its list. @throws InputError
  };

  inline const std::string &name_of(const ProfileEntry &entry) { return entry.name; } ///< For Registry.

  /// All kinds, in the order of `profiles/list.def`, then those of plug-ins.
  Registry<ProfileEntry> &profile_registry();
} // namespace myolines
