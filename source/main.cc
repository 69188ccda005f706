// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/cli/mpi_session.h>
#include <myolines/cli/program.h>

#include <cstdlib>
#include <iostream>

#include <fcntl.h>

namespace
{
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
