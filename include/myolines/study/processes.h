// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <sys/types.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace myolines::study
{
  /// How a child process ended.
  struct Ended
  {
    pid_t  process     = 0;  ///< its number
    int    exit_code   = -1; ///< if it ended by itself
    int    signal      = 0;  ///< that ended it, otherwise
    double cpu_seconds = 0;  ///< user and system
  };

  /// Child processes of this one. They die with it, however it dies, and hear no signals of its terminal. One object at a time.
  /// Their environment is that with which this program was started, less what an MPI library has put there.
  class Processes
  {
  public:
    Processes();  ///< Blocks the signals that wait() looks for.
    ~Processes(); ///< kills what is left
    Processes(const Processes &)            = delete;
    Processes &operator=(const Processes &) = delete;

    /// Starts @p command; what it prints goes to the file @p console. @throws SystemError.
    pid_t start(const std::vector<std::string> &command, const std::filesystem::path &console);

    /// Starts @p body in a copy of this process, which ends with the exit code that it returns. The copy has no open files of this
    /// process. This process must have one thread and must not have started MPI. @throws as above.
    pid_t start(const std::function<int()> &body, const std::filesystem::path &console);

    /// Waits until a process ends, a signal arrives or @p seconds have passed; all that have ended.
    std::vector<Ended> wait(double seconds);

    void send(pid_t process, int signal) const; ///< A signal to one of them.

  private:
    /// Forks; @p child runs in the child once it is set up, and ends it.
    pid_t fork_child(const std::function<void()> &child, const std::filesystem::path &console);

    std::vector<pid_t> alive_;
    sigset_t           before_; ///< blocked signals
  };

  /// The program of this process.
  std::filesystem::path this_program();
} // namespace myolines::study
