// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

namespace myolines
{
  /// While it lives, no other process has the lock of @p file (one of its parts may, if it is shared). The system frees it when the
  /// process ends, however it ends. The file goes with the last object that has its lock; one that a killed process left does no harm.
  class FileLock
  {
  public:
    /// Who else may have the lock.
    enum class Kind
    {
      shared,   ///< others that share it
      exclusive ///< nobody
    };

    /// @p holder is what another process that has it would be: "another run", for the message. A file system that knows no locks gives
    /// none. @throws InputError if another process has it, or the folder cannot be written.
    FileLock(const std::filesystem::path &file, Kind kind, const std::string &holder);
    ~FileLock(); ///< Gives the lock back.
    FileLock(const FileLock &)            = delete;
    FileLock &operator=(const FileLock &) = delete;

  private:
    void lock(Kind kind, const std::string &holder);
    bool is_in_place() const;

    std::filesystem::path file_;
    int                   descriptor_ = -1;
  };
} // namespace myolines
