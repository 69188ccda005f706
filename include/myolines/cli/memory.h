// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>

#include <string>
#include <vector>

namespace myolines
{
  /// Memory that a run of @p scene will take on this rank, estimated from the parameters alone, in lines for `check`.
  std::vector<std::string> memory_lines(const scene::Node &scene);

  /// Of the program with its libraries, in every process, measured [bytes].
  constexpr double memory_of_the_program = 0.2e9;

  /// That estimate [bytes].
  double memory_of_a_rank(const scene::Node &scene);

  /// @throws InputError, before anything large is made, if the ranks of this node together want more than it gives (memory_limit()), or one
  /// of them more than a process may have: with the numbers and how to mend it. Collective.
  void refuse_too_large(const scene::Node &scene);

  /// How many runs of @p bytes_of_a_run each this node has memory for at a time: @p wanted at most, 1 at least.
  /// @throws InputError if @p wanted do not fit and were @p asked_for.
  unsigned int jobs_that_fit(double bytes_of_a_run, unsigned int wanted, bool asked_for);
} // namespace myolines
