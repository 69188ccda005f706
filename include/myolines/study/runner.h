// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/cases.h>
#include <myolines/study/database.h>

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace myolines::study
{
  /// How cases are run.
  struct RunnerOptions
  {
    std::filesystem::path              program; ///< that has the command `run`
    std::vector<std::filesystem::path> plugins; ///< files that each run loads, beside what its scene names
    /// Runs a command line of the program in a copy of this process and returns its exit code; see Processes. If there is none, or
    /// where a case has several ranks, each case is started as a process of its own.
    std::function<int(const std::vector<std::string> &command)> run_in_copy;
    std::filesystem::path                                       folder;        ///< of the study; runs go to cases/NAME in it
    unsigned int                                                jobs  = 1;     ///< runs at a time
    bool                                                        retry = false; ///< cases that did not end as "done" are run again
    /// The resolved scene of a case. @throws InputError if its settings do not fit the scene.
    std::function<std::string(const Case &which)> resolve;
    /// How many of the jobs have room at a time, once all cases were resolved; may be none. @throws InputError.
    std::function<unsigned int(unsigned int jobs)> fitting_jobs;
    std::function<int()>                           stop_signal;        ///< 0 until one is noted
    std::ostream                                  *terminal = nullptr; ///< for the progress; may be none
  };

  /// How far a study has come.
  struct RunnerReport
  {
    std::size_t n_known = 0; ///< cases that had ended before
    std::size_t n_run   = 0; ///< that ended now
    std::size_t n_open  = 0; ///< that are still to be run
    std::string why_open;    ///< "signal 15", "the total budget of 60 s is spent"; "" if none is
  };

  /// Folder of the run of a case.
  std::filesystem::path case_folder(const std::filesystem::path &study_folder, const std::string &case_name);

  /// Runs the @p cases that @p database does not hold yet, or holds of another scene or without their folder, each in a process
  /// of its own: `program run SCENE --set ... --out FOLDER --quiet`, under `mpirun -np RANKS` if the study has more than one. A case counts
  /// once its process has ended by itself or by its time-out; its outcome is in the database before the next one starts. Killed at any
  /// moment and called again, it goes on with the cases that were not in the database. Progress goes to study.log in the folder and to the
  /// terminal.
  RunnerReport run_cases(const Study &study, const std::vector<Case> &cases, Database &database, const RunnerOptions &options);
} // namespace myolines::study
