// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdlib>
#include <utility>

namespace myolines
{
  /// For Open MPI, of a process that is no rank of a job: no helper daemon, no search for networks that it will not use, and no session
  /// folder, which all such processes would make and remove under the same name at the same time.
  inline constexpr std::pair<const char *, const char *> lone_process_variables[] = {{"OMPI_MCA_ess_singleton_isolated", "1"},
                                                                                     {"OMPI_MCA_orte_create_session_dirs", "0"},
                                                                                     {"OMPI_MCA_pml", "ob1"},
                                                                                     {"OMPI_MCA_btl", "self"}};

  /// Whether `mpirun` or a batch system has started this process as one of several.
  inline bool is_rank_of_a_job()
  {
    for (const char *variable : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
      if (std::getenv(variable) != nullptr)
        return true;
    return false;
  }
} // namespace myolines
