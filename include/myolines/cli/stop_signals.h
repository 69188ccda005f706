// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <csignal>

namespace myolines
{
  /// While it lives, SIGTERM, SIGINT, SIGUSR1, SIGHUP and SIGXCPU do not end the program but are noted, for the run to end after its step.
  /// A second signal of a kind acts as usual (not SIGXCPU, which comes every second). A hang-up that the user had ignored (nohup) stays
  /// ignored; a pipe that nobody reads any more does not end the program. One object at a time, as a process has one handler for each
  /// signal.
  class StopSignals
  {
  public:
    StopSignals();  ///< notes signals from now on
    ~StopSignals(); ///< signals act as before
    StopSignals(const StopSignals &)            = delete;
    StopSignals &operator=(const StopSignals &) = delete;

    /// The last signal noted, 0 if none.
    int noted() const;

  private:
    static constexpr std::array<int, 6> numbers{{SIGTERM, SIGINT, SIGUSR1, SIGHUP, SIGXCPU, SIGPIPE}};
    std::array<struct sigaction, 6>     before_;
  };
} // namespace myolines
