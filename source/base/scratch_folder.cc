// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/scratch_folder.h>

#include <cerrno>

#include <stdlib.h>

namespace myolines
{
  ScratchFolder::ScratchFolder()
  {
    std::error_code none;
    const auto      among = std::filesystem::temp_directory_path(none);
    std::string     name  = ((none ? std::filesystem::path("/tmp") : among) / "myolines_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw SystemError("make a folder in", among, errno);
    path_ = name;
  }

  ScratchFolder::~ScratchFolder()
  {
    std::error_code ignored; // a left-over folder must not hide the verdict
    std::filesystem::remove_all(path_, ignored);
  }
} // namespace myolines
