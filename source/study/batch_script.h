#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myolines::study
{
  /// What a batch script calls; absolute paths.
  struct BatchCall
  {
    std::filesystem::path    program, file, folder;
    std::vector<std::string> overrides;
    unsigned int             tasks;
  };

  /// Array job of Slurm: every task runs its part with as many processes as it has cores; a last job takes the results together.
  std::string slurm_script(const BatchCall &call);

  /// One MPI job: every rank runs its part, one process at a time, and then one process takes the results together.
  std::string mpi_script(const BatchCall &call);
} // namespace myolines::study
