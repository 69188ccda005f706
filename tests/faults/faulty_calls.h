// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace myolines::test
{
  /// What becomes of one call of the system that touches a file below a folder.
  struct Fault
  {
    long at      = 0;     ///< number of the call, from 1; 0: none
    int  error   = 0;     ///< errno with which it fails; 0: the process is killed there (SIGKILL)
    bool lasting = false; ///< calls that need room on the disk fail from then on as well
  };

  /// The calls of a command and of all processes that it starts by fork.
  class CallList
  {
  public:
    CallList();
    ~CallList();
    CallList(const CallList &)            = delete;
    CallList &operator=(const CallList &) = delete;

    void        clear();
    std::string text() const; ///< one call a line: what it does and to which file

    /// Notes a call and returns its number.
    long add(const char *call, const char *path);

  private:
    struct Shared;
    Shared *shared_;
  };

  /// From now on, calls of this process and of those that it forks go into @p list if they open, write, cut, move, remove, sync or close a
  /// file below @p folder, or make a folder there; the one of @p fault fails. A write that is to fail, or in which the process is to be
  /// killed, writes half of what it was asked for first, as a disk does that becomes full. Left out are locks, captured streams, and the
  /// closing of files that are on the disk already.
  void watch_calls(const std::string &folder, CallList &list, const Fault &fault);
} // namespace myolines::test
