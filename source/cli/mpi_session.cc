// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/lone_process.h>
#include <myolines/cli/mpi_session.h>

#include <algorithm>
#include <cstdlib>

// Of OpenBLAS, where that is the BLAS in use.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace myolines
{
  MpiSession::MpiSession(int &argc, char **&argv)
    : argc_(argc)
    , argv_(argv)
  {}

  void MpiSession::start()
  {
    if (started())
      return;
    if (!is_rank_of_a_job())
      for (const auto &[variable, value] : lone_process_variables)
        setenv(variable, value, /*overwrite*/ 0);
    // Of the arguments only the name: PETSc, which deal.II starts, takes the others for options of its own that nobody used.
    int argc = std::min(argc_, 1);
    mpi_     = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(argc, argv_, 1);
    if (openblas_set_num_threads != nullptr)
      openblas_set_num_threads(1);
  }
} // namespace myolines
