// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/driver.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace myolines::study
{
  /// Every n-th case, from the one of @p number on: what one task of an array job does.
  struct Part
  {
    unsigned int number = 1; ///< of the part, from 1
    unsigned int of     = 1; ///< how many parts there are
  };

  /// "2/8". @throws InputError unless 1 <= number <= of.
  Part read_part(const std::string &text);

  /// What `study` is asked for.
  struct Options : Driver
  {
    std::filesystem::path    file;         ///< that describes the study
    std::filesystem::path    folder;       ///< empty: results/ and the name of the study without extension
    std::vector<std::string> overrides;    ///< "path=value" of that file
    bool                     list = false; ///< validate and print the cases, run none
    std::string              part;         ///< as read_part() takes it; "" for all
    std::string              emit;         ///< "slurm", "mpi": write that script and run nothing; "" for none
    unsigned int             tasks = 8;    ///< of the script: parts, one case at a time in each
  };

  /// The command `study`: runs the cases of a study that have not been run, measures all that are done and writes
  /// study.csv, seconds.csv, equal_error.csv, study.sqlite and study.resolved.xml to its folder.
  /// A part writes only its database, which the next run of the whole study takes over.
  /// @throws InputError, and Interrupted if cases are left open by a signal or the budget.
  void study_command(const Options &options, std::ostream &out);
} // namespace myolines::study
