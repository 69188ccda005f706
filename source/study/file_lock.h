#pragma once

#include <filesystem>

namespace myolines::study
{
  /// While it lives, no other process has the lock of @p file (one of its parts may, if it is shared). The system frees it when the
  /// process ends, however it ends.
  class FileLock
  {
  public:
    enum class Kind
    {
      shared,
      exclusive
    };

    /// @throws InputError if another process has it.
    FileLock(const std::filesystem::path &file, Kind kind);
    ~FileLock();
    FileLock(const FileLock &)            = delete;
    FileLock &operator=(const FileLock &) = delete;

  private:
    int descriptor_;
  };
} // namespace myolines::study
