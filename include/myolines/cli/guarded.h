#pragma once

#include <myolines/base/error.h>

#include <functional>
#include <ostream>

namespace myolines
{
  /// Runs @p command and says on @p err what it throws; the code is that of what was thrown. Where other ranks may not know of it, the
  /// whole job ends here.
  ExitCode guarded(const std::function<void()> &command, std::ostream &err);

  /// @p code, unless what was printed to standard output has not arrived.
  ExitCode flushed(ExitCode code);
} // namespace myolines
