// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

/// What stands before the program for run_program() to run it on @p n ranks: mpirun, not as a child of this process, whose MPI library has
/// set variables that mpirun would heed.
inline std::string on_ranks(const int n)
{
  return "env -i PATH=\"$PATH\" HOME=\"$HOME\" ASAN_OPTIONS=\"$ASAN_OPTIONS\" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
         "OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe OMP_NUM_THREADS=1 mpirun -np " +
         std::to_string(n);
}
