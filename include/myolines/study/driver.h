// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/runner.h>

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace myolines::study
{
  /// How runs of this program are started, resolved and stopped, for the commands that start many.
  struct Driver
  {
    unsigned int jobs  = 0;     ///< runs at a time; 0: as many as the cores have room for
    bool         retry = false; ///< see RunnerOptions

    std::filesystem::path                                       program;     ///< that has the command `run`
    std::vector<std::filesystem::path>                          plugins;     ///< see RunnerOptions
    std::function<int(const std::vector<std::string> &command)> run_in_copy; ///< see RunnerOptions; may be none
    std::function<void()>                                       start_mpi;   ///< called after the runs and before fields are measured
    /// How many of so many runs of so many ranks each, asked for or not, have room at a time, once all cases were resolved; may be none.
    std::function<unsigned int(unsigned int jobs, unsigned int ranks, bool asked_for)> fitting_jobs;
    /// The resolved scene of a case. @throws InputError if the settings do not fit the scene.
    std::function<std::string(const std::filesystem::path &scene, const std::vector<std::string> &settings)> resolve;
    /// the signal that asks to stop, 0: none
    std::function<int()> stop_signal;
    std::ostream        *terminal = nullptr; ///< for the progress; may be none
  };

  /// What the runner needs for the cases of @p study, in @p folder. Both are borrowed.
  RunnerOptions runner_options(const Driver &driver, const Study &study, const std::filesystem::path &folder);

  /// @throws Interrupted if cases are open.
  void throw_if_open(const RunnerReport &report);

  /// @throws InputError on a rank of many: the command @p name starts the runs itself.
  void require_one_process(const std::string &name, const std::string &hint);
} // namespace myolines::study
