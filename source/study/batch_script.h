// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myolines::study
{
  /// What a batch script calls; absolute paths.
  struct BatchCall
  {
    std::filesystem::path              program, file, folder;
    std::vector<std::string>           overrides;
    std::vector<std::filesystem::path> plugins;
    unsigned int                       tasks;
    unsigned int                       ranks; ///< of a case
  };

  /// Array job of Slurm: every task runs its part, with as many processes as it has cores, or one run of `ranks` ranks after the other;
  /// a last call takes the results together.
  std::string slurm_script(const BatchCall &call);

  /// One MPI job of tasks x ranks, in groups of `ranks`: every group runs its part, one case at a time, and then one process takes the
  /// results together. A group is within a node.
  std::string mpi_script(const BatchCall &call);
} // namespace myolines::study
