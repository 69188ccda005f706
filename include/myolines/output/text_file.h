#pragma once

#include <filesystem>
#include <string>

namespace myolines
{
  /// True on the one rank that writes text files (rank 0, also without MPI). Values to write are the same on all ranks.
  bool writes_files();

  /// Replaces @p file by @p text in one move, so that a reader or a kill never sees half of it. Does nothing on ranks
  /// that do not write. @throws std::runtime_error with the path if the disk refuses.
  void replace_file(const std::filesystem::path &file, const std::string &text);

  /// Shortest decimal text that reads back as exactly @p value (at most 17 significant digits).
  std::string exact_text(double value);

  /// Now, UTC, ISO 8601: "2025-03-01T12:00:00Z".
  std::string iso8601_now();
} // namespace myolines
