// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/cli/experiment.h>

#include <string>
#include <vector>

namespace myolines
{
  /// "off  output fields: not asked for": outputs that cost nothing because the scene does not ask for them.
  std::vector<std::string> skipped_outputs(const Experiment &experiment);

  /// What a run computes, what it skips and why, how it solves: a line each.
  std::vector<std::string> plan_of(const Experiment &experiment);

  /// What a run will cost, a line: the CPU time of its first steps, which are taken, times the number of steps where that is known.
  /// Gives up after some seconds. Collective; the experiment is used up.
  std::string predicted_cost(Experiment &experiment);
} // namespace myolines
