// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

namespace myolines
{
  /// A warning if the ranks of this job have to share cores with each other or with other programs: ranks of Open MPI spin while they wait,
  /// so that a rank without a core of its own holds up all others. Measured: all ranks compute for 60 ms of wall clock and count the CPU
  /// time that they got. Nothing is measured for a single rank. Collective.
  std::optional<std::string> warning_of_shared_cores();
} // namespace myolines
