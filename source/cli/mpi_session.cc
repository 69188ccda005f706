// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/lone_process.h>
#include <myolines/cli/mpi_session.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include <dlfcn.h>
#include <sys/mman.h>

namespace myolines
{
  namespace
  {
    /// A function of OpenBLAS, where that is the BLAS in use; else null. It is asked for by name, as the program is linked to whatever
    /// library has the names of BLAS, and mold settles weak references when it links.
    template <class Function>
    Function *of_open_blas(const char *name)
    {
      return reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, name));
    }

    /// OpenBLAS asks for its working memory where it first needs it, and where the system refuses it asks again, for ever; Open MPI ends
    /// the process. So there is room for both before they begin, and OpenBLAS gets its own, which it keeps.
    /// @throws SystemError if there is none.
    void give_memory_to_libraries()
    {
      constexpr std::size_t megabyte = 1 << 20, of_blas = 129 * megabyte, of_mpi = 96 * megabyte; // as they take on x86-64
      void *const           room = mmap(nullptr, of_blas + of_mpi, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
      if (room == MAP_FAILED)
        throw SystemError("out of memory: there are no 225 MB of addresses for OpenBLAS and Open MPI (limits of the process: ulimit -v)",
                          errno);
      munmap(room, of_blas + of_mpi);
      const auto allocate = of_open_blas<void *(int)>("blas_memory_alloc");
      const auto release  = of_open_blas<void(void *)>("blas_memory_free");
      if (allocate != nullptr && release != nullptr)
        release(allocate(0));
    }
  } // namespace

  MpiSession::MpiSession(int &argc, char **&argv)
    : argc_(argc)
    , argv_(argv)
  {}

  void MpiSession::start()
  {
    if (started())
      return;
    give_memory_to_libraries();
    if (!is_rank_of_a_job())
      for (const auto &[variable, value] : lone_process_variables)
        setenv(variable, value, /*overwrite*/ 0);
    // Of the arguments only the name: PETSc, which deal.II starts, takes the others for options of its own that nobody used.
    int argc = std::min(argc_, 1);
    mpi_     = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(argc, argv_, 1);
    if (const auto set_threads = of_open_blas<void(int)>("openblas_set_num_threads"))
      set_threads(1);
  }
} // namespace myolines
