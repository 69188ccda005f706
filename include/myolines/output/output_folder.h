#pragma once

#include <myolines/system/archive.h>

#include <filesystem>

namespace myolines
{
  /// Where the outputs of a run go and, in a resumed run, what they saved when it was kept: every output made with it goes on
  /// where it was then, or begins anew if it saved nothing.
  struct OutputFolder
  {
    OutputFolder(std::filesystem::path folder, const Archive *saved_outputs = nullptr)
      : path(std::move(folder))
      , saved(saved_outputs)
    {}

    std::filesystem::path path;
    const Archive        *saved; ///< nullptr in a run from its start; borrowed
  };
} // namespace myolines
