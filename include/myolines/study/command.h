#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace myolines::study
{
  /// Every n-th case, from the one of @p number on: what one task of an array job does.
  struct Part
  {
    unsigned int number = 1, of = 1;
  };

  /// "2/8". @throws InputError unless 1 <= number <= of.
  Part read_part(const std::string &text);

  struct Options
  {
    std::filesystem::path    file;
    std::filesystem::path    folder; ///< empty: results/<name of the study without extension>
    std::vector<std::string> overrides;
    unsigned int             jobs  = 0; ///< runs at a time; 0: as many as the cores have room for
    bool                     retry = false;
    bool                     list  = false; ///< validate and print the cases, run none
    std::string              part;          ///< as read_part() takes it; "" for all
    std::string              emit;          ///< "slurm", "mpi": write that script and run nothing; "" for none
    unsigned int             tasks = 8;     ///< of the script: parts, one case at a time in each

    std::filesystem::path                                       program;     ///< that has the command `run`
    std::function<int(const std::vector<std::string> &command)> run_in_copy; ///< see RunnerOptions; may be none
    std::function<void()>                                       start_mpi;   ///< called after the runs and before they are measured
    /// How many of so many runs of so many ranks each, asked for or not, have room at a time, once all cases were resolved; may be none.
    std::function<unsigned int(unsigned int jobs, unsigned int ranks, bool asked_for)> fitting_jobs;
    /// The resolved scene of a case. @throws InputError if the settings do not fit the scene.
    std::function<std::string(const std::filesystem::path &scene, const std::vector<std::string> &settings)> resolve;
    std::function<int()>                                                                                     stop_signal;
    std::ostream *terminal = nullptr; ///< for the progress; may be none
  };

  /// The command `study`: runs the cases of a study that have not been run, measures all that are done and writes
  /// study.csv, seconds.csv, equal_error.csv, study.sqlite and study.resolved.xml to its folder.
  /// A part writes only its database, which the next run of the whole study takes over.
  /// @throws InputError, and Interrupted if cases are left open by a signal or the budget.
  void study_command(const Options &options, std::ostream &out);
} // namespace myolines::study
