// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/cli/mpi_session.h>

namespace myolines
{
  /// The program `myolines`: parses the command line, runs one command, reports errors on stderr (rank 0).
  /// Returns the exit code, see ExitCode. Starts @p mpi at once, but for a study only when its cases have been run: copies of its process
  /// run them, which start MPI themselves.
  int program(int argc, const char *const *argv, MpiSession &mpi);
} // namespace myolines
