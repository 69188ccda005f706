// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>

namespace myolines
{
  /// A folder of its own among the temporary ones, which no other user can read; it vanishes with the object.
  class ScratchFolder
  {
  public:
    ScratchFolder();                                          ///< @throws SystemError
    ~ScratchFolder();                                         ///< Removes the folder with all that is in it.
    ScratchFolder(const ScratchFolder &)            = delete; ///< The folder has one owner.
    ScratchFolder &operator=(const ScratchFolder &) = delete;

    const std::filesystem::path &path() const { return path_; } ///< Where it is.

  private:
    std::filesystem::path path_;
  };
} // namespace myolines
