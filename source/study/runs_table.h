// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/database.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace myolines::study
{
  /// How a run ended, and what it has for some quantities. Both are borrowed.
  struct RunRow
  {
    const std::string                 *name;
    const Outcome                     *outcome;
    std::vector<std::optional<double>> values;
  };

  /// runs.csv in @p folder, a row for each.
  void write_runs_table(const std::vector<std::string> &quantities, const std::vector<RunRow> &rows, const std::filesystem::path &folder);
} // namespace myolines::study
