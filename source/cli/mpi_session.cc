#include <myolines/cli/mpi_session.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

// Of OpenBLAS, where that is the BLAS in use.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace myolines
{
  namespace
  {
    /// For Open MPI, of a process that is no rank of a job: no helper daemon, no search for networks that it will not use, and no session
    /// folder, which all such processes would make and remove under the same name at the same time.
    constexpr std::pair<const char *, const char *> alone[] = {{"OMPI_MCA_ess_singleton_isolated", "1"},
                                                               {"OMPI_MCA_orte_create_session_dirs", "0"},
                                                               {"OMPI_MCA_pml", "ob1"},
                                                               {"OMPI_MCA_btl", "self"}};
  } // namespace

  MpiSession::MpiSession(int &argc, char **&argv)
    : argc_(argc)
    , argv_(argv)
  {}

  bool MpiSession::is_rank_of_a_job()
  {
    for (const char *variable : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
      if (std::getenv(variable) != nullptr)
        return true;
    return false;
  }

  void MpiSession::start()
  {
    if (started())
      return;
    if (!is_rank_of_a_job())
      for (const auto &[variable, value] : alone)
        setenv(variable, value, /*overwrite*/ 0);
    // Of the arguments only the name: PETSc, which deal.II starts, takes the others for options of its own that nobody used.
    int argc = std::min(argc_, 1);
    mpi_     = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(argc, argv_, 1);
    if (openblas_set_num_threads != nullptr)
      openblas_set_num_threads(1);
  }
} // namespace myolines
