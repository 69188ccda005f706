// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/cli/mpi_session.h>
#include <myolines/cli/program.h>

#include <csignal>
#include <cstdlib>
#include <iostream>

#include <fcntl.h>

namespace
{
  /// What the process was told to do at a hang-up, nohup for one to ignore it. UCX, which Open MPI 5 links, catches the signal while the
  /// libraries are loaded, so it is asked for before that.
  struct sigaction at_hang_up
  {
  };

  void note_hang_up(int, char **, char **) { sigaction(SIGHUP, nullptr, &at_hang_up); }

  [[gnu::used, gnu::section(".preinit_array")]] void (*const before_libraries)(int, char **, char **) = note_hang_up;

  /// A closed standard stream is opened for nothing, so that no file of a run gets its number, and with that what is printed.
  void hold_standard_streams()
  {
    for (int stream = 0; stream <= 2; ++stream)
      if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", O_RDONLY) < 0)
        return;
  }
} // namespace

int main(int argc, char **argv)
{
  sigaction(SIGHUP, &at_hang_up, nullptr);
  hold_standard_streams();
  myolines::MpiSession mpi(argc, argv);
  const int            code = myolines::program(argc, argv, mpi);
  if (code == static_cast<int>(myolines::ExitCode::system_refused) && !mpi.started())
    {
      // OpenBLAS waits at the end for its threads, and these may wait for memory that they never get.
      std::cout.flush();
      std::_Exit(code);
    }
  return code;
}
