// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace myolines
{
  /// True on the one rank that writes text files: rank 0, also without MPI or before it is started. Values to write are the same on all
  /// ranks.
  bool writes_files();

  /// Replaces @p file by @p text in one move, so that a reader or a kill never sees half of it. Does nothing on ranks
  /// that do not write. @throws SystemError.
  void replace_file(const std::filesystem::path &file, const std::string &text);

  /// Makes @p folder, and those above it, where it is not there. @throws SystemError.
  void make_folder(const std::filesystem::path &folder);

  /// Removes @p file if it is there. @throws SystemError.
  void remove_file(const std::filesystem::path &file);

  /// Returns once what was written to @p file, or the names in a folder, is on the disk itself.
  /// @throws SystemError.
  void sync_to_disk(const std::filesystem::path &file);

  /// Runs @p action on the rank that writes; what it throws, all ranks throw: an InputError, a SystemError if the disk is full or broken,
  /// and for anything else an InputError about @p where with its message, what was @p expected and how to mend it.
  void on_writing_rank(const std::string &where, const std::string &expected, const std::string &hint, const std::function<void()> &action);

  /// Shortest decimal text that reads back as exactly @p value (at most 17 significant digits).
  std::string exact_text(double value);

  /// Now, UTC, ISO 8601: "2025-03-01T12:00:00Z".
  std::string iso8601_now();
} // namespace myolines
