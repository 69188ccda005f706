// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/driver.h>

#include <filesystem>
#include <string>
#include <vector>

namespace myolines::study
{
  /// A question about values of a scene, which runs of variants of it answer.
  struct QuantityOptions : Driver
  {
    std::filesystem::path    scene;        ///< file of the scene
    std::vector<std::string> overrides;    ///< "path=value", in their order
    std::vector<std::string> quantities;   ///< "FILE:COLUMN", ":last" (default), ":largest", ":smallest" or ":at TIME" after it
    std::filesystem::path    folder;       ///< empty: results/ and the name of the scene, with the command after it
    double                   at_most = 10; ///< CPU seconds of a run on a finer mesh over those of the scene
    unsigned int             ranks   = 1;  ///< of each run
  };

  /// A study of the scene, without cases, whose runs may take a week.
  Study study_of(const QuantityOptions &options);

  /// The folder for the results of @p command, which is made. @throws SystemError.
  std::filesystem::path made_folder(const QuantityOptions &options, const std::string &command);
} // namespace myolines::study
