#pragma once

namespace myolines
{
  /// The program `myolines`: parses the command line, runs one command, reports errors on stderr (rank 0).
  /// Returns the exit code, see ExitCode. MPI must be initialised.
  int program(int argc, const char *const *argv);
} // namespace myolines
