// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bindings.h"

#include <myolines/cli/mpi_session.h>
#include <myolines/cli/versions.h>
#include <myolines/output/version.h>

#include <deal.II/base/mpi.h>

#include <dlfcn.h>

#include <memory>

namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    namespace
    {
      MpiSession *session = nullptr; // Py_AtExit takes a function without arguments

      void end_mpi()
      {
        if (session != nullptr)
          session->end();
      }
    } // namespace

    void need_mpi()
    {
      if (session != nullptr)
        return;
      int started = 0;
      MPI_Initialized(&started);
      if (started != 0)
        throw std::runtime_error("MPI has been started by another package: import and use myolines first, or with mpi4py say "
                                 "`mpi4py.rc.initialize = False` before `from mpi4py import MPI`");
      static char       name[] = "myolines", *words[] = {name, nullptr};
      static int        n_words   = 1;
      static char     **arguments = words;
      static MpiSession the_session(n_words, arguments);
      the_session.start();
      session = &the_session;
      Py_AtExit(end_mpi);
    }
  } // namespace python
} // namespace myolines

PYBIND11_MODULE(_core, module)
{
  using namespace myolines;
  using namespace myolines::python;
  module.doc() = "What the package myolines needs of the library; see the package for everything that is meant to be used.";
  // Plug-ins look for the library among the symbols that all may see; Python has loaded it for this module alone.
  dlopen(MYOLINES_LIBRARY, RTLD_NOLOAD | RTLD_GLOBAL | RTLD_NOW);
  bind_errors(module);
  bind_scenes(module);
  bind_runs(module);
  bind_systems(module);
  bind_simulations(module);
  bind_methods(module);
  module.attr("folder_of_program") = MYOLINES_FOLDER_OF_PROGRAM; // from that of the installed package
  module.def(
      "barrier",
      [] {
        need_mpi();
        without_lock([] { MPI_Barrier(MPI_COMM_WORLD); });
      },
      "Waits until all ranks are here.");
  module.def(
      "version", [] { return std::string(version); }, "Version of the library.");
  module.def(
      "versions", [] { return versions_text(); }, "Versions of the library and of those that it uses, in lines.");
  module.def(
      "rank",
      [] {
        need_mpi();
        return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      },
      "Number of this process among those that mpirun has started, from 0.");
  module.def(
      "ranks",
      [] {
        need_mpi();
        return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      },
      "How many processes work together.");
  module.def(
      "abort_all",
      [](const int code) {
        if (session != nullptr && dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
          MPI_Abort(MPI_COMM_WORLD, code);
      },
      py::arg("code"), "Ends all ranks, where one has failed and others would wait for it.");
}
