// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

namespace myolines::scene
{
  /// The text of a file that a person gives: a regular file, not empty, in UTF-8 and without zero bytes. A byte order mark is left out.
  /// Carriage returns that alone end lines become new lines. @throws InputError that names the file and what is wrong with it.
  std::string read_input_text(const std::filesystem::path &file);

  /// The same, byte by byte, for files that may be binary; a byte order mark is left out as well.
  std::string read_input_bytes(const std::filesystem::path &file);
} // namespace myolines::scene
