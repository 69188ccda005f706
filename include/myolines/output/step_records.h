// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/output/output_folder.h>
#include <myolines/time/loop.h>

#include <functional>
#include <memory>
#include <string>

namespace myolines
{
  using Warn = std::function<void(const std::string &)>; ///< Hears of what a person should know while a run goes on.

  /// Status line per step on a terminal, one line per step in run.log, always run.log; on rank 0. @p warn hears there, once, of steps by
  /// error that have become too many (Pace); it may be empty.
  std::unique_ptr<Observer> make_status(const OutputFolder &folder, double start, double end, bool quiet, Warn warn = {});
  /// steps.csv: number, t, dt, outcome, iterations, residuals of every attempt, rejected ones included.
  std::unique_ptr<Observer> make_steps_file(const OutputFolder &folder);
} // namespace myolines
