// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/picture.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace myolines::study
{
  /// What `plot` is asked for.
  struct PlotOptions
  {
    std::vector<std::filesystem::path> folders; ///< a study, a run, or several runs
    std::filesystem::path              out;     ///< empty: pictures/ in the folder, or here if there are several
    std::string                        file;    ///< of runs: only this CSV file; "" for all
  };

  /// The command `plot`: pictures of a study by its kind, of all series of a run, or of those that several runs share.
  /// @throws InputError if a folder holds neither.
  void plot_command(const PlotOptions &options, std::ostream &out);

  /// One picture for each file and unit of a single run, one for each file and column of several.
  std::vector<Picture> pictures_of_runs(const std::vector<std::filesystem::path> &folders, const std::string &file);

  /// Whether no curve has more than the point of one instant: runs that wrote no step.
  bool have_one_instant(const std::vector<Picture> &pictures);

  /// By the kind of the study in @p folder, from its study.csv and seconds.csv.
  std::vector<Picture> pictures_of_study(const std::filesystem::path &folder);
} // namespace myolines::study
