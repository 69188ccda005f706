#pragma once

#include <array>
#include <csignal>

namespace myolines
{
  /// While it lives, SIGTERM, SIGINT and SIGUSR1 do not end the program but are noted, for the run to end after its step. A second
  /// signal of a kind acts as usual. One object at a time, as a process has one handler for each signal.
  class StopSignals
  {
  public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals &)            = delete;
    StopSignals &operator=(const StopSignals &) = delete;

    /// The last signal noted, 0 if none.
    int noted() const;

  private:
    static constexpr std::array<int, 3> numbers{{SIGTERM, SIGINT, SIGUSR1}};
    std::array<struct sigaction, 3>     before_;
  };
} // namespace myolines
