// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/report/command.h>

namespace myolines
{
  /// The values of the scene in @p file that are not the defaults of their parameters, or have none, in the order of the scene.
  /// @throws InputError as read_whole_scene() does.
  std::vector<report::ChangedValue> changed_values(const std::filesystem::path &file);
} // namespace myolines
