// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reports.h"

namespace myolines::report
{
  /// What a run tells in few words.
  struct RunFacts
  {
    std::vector<Cells>          glance;   ///< name and value
    std::vector<std::string>    verdicts; ///< how far the numbers may be trusted
    std::vector<Cells>          rejected; ///< steps that were refused: time, size, outcome, reason
    std::vector<study::Picture> steps;    ///< sizes and iterations over time
  };

  RunFacts facts_of(const std::filesystem::path &folder, const Json &manifest);
} // namespace myolines::report
