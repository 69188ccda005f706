// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>

#include <functional>
#include <ostream>

namespace myolines
{
  /// Runs @p command and tells what it throws on @p err; the exit code of the program. An error that other ranks may not know of ends the
  /// whole job.
  ExitCode guarded(const std::function<void()> &command, std::ostream &err);

  /// @p code, or that of a system that refused if what was printed could not be written.
  ExitCode flushed(ExitCode code);
} // namespace myolines
