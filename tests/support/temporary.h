// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <unistd.h>

namespace myolines::test
{
  /// A path in a folder of this process alone, as tests run side by side; the folder goes when the process ends.
  inline std::filesystem::path temporary(const std::string &name)
  {
    struct Folder
    {
      Folder() { std::filesystem::create_directories(path); }
      ~Folder()
      {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
      }
      const std::filesystem::path path = std::filesystem::temp_directory_path() / ("myolines_test_" + std::to_string(::getpid()));
    };
    static const Folder folder;
    return folder.path / name;
  }
} // namespace myolines::test
