// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/mpi.h>

#include <memory>

namespace myolines
{
  /// MPI and the libraries that are set up with it, from start() to the end of this object. One thread a rank: threads inside vector and
  /// matrix operations only compete with the ranks.
  class MpiSession
  {
  public:
    /// @p argc and @p argv are those of main(), and live as long as this.
    MpiSession(int &argc, char **&argv);

    /// Starts MPI unless that has been done. A process that is no rank of a job does without networks, and without the helper daemon that
    /// Open MPI gives to such processes; variables of the environment that are set already are respected. @throws SystemError if there is
    /// no memory for these libraries.
    void start();

    /// Ends MPI before this object ends.
    void end() { mpi_.reset(); }

    bool started() const { return mpi_ != nullptr; } ///< whether MPI runs

  private:
    int                                                      &argc_;
    char                                                   **&argv_;
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> mpi_;
  };
} // namespace myolines
