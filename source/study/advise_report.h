// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "advise_search.h"

#include <string>

namespace myolines::study
{
  /// What was found, borrowed.
  struct AdviceReport
  {
    const Pilot         &pilot;
    const Choices       &choices;
    const TimeReference &reference;
    const MeshChoice    &mesh;
    const Search        &search;
    const Advice        &advice;
  };

  /// For people.
  std::string advice_text(const AdviceReport &report);

  /// advise.csv and runs.csv in @p folder.
  void write_advice_tables(const AdviceReport &report, const std::filesystem::path &folder);
} // namespace myolines::study
