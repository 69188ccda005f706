// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/cli/mpi_session.h>
#include <myolines/cli/program.h>

#include <csignal>
#include <cstdlib>
#include <iostream>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace
{
  /// What the process was told to do at a hang-up, nohup for one to ignore it. UCX, which Open MPI 5 links, catches the signal while the
  /// libraries are loaded, so it is asked for before that.
  struct sigaction at_hang_up
  {
  };

  /// OpenBLAS 0.3.29 asks for 128 MB while it is loaded, and where the system refuses it asks again, for ever. Where there is no such room
  /// the process ends here, as no solve could begin; only plain calls of the system are allowed yet.
  void refuse_without_room_for_blas()
  {
    constexpr std::size_t room  = 136 << 20;
    void *const           place = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (place != MAP_FAILED)
      munmap(place, room);
    else
      {
        constexpr char message[] =
            "The system refused: out of memory: there are no 136 MB of addresses for OpenBLAS (limits of the process: ulimit -v)\n";
        [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof(message) - 1);
        _exit(static_cast<int>(myolines::ExitCode::system_refused));
      }
  }

  void before_libraries_begin(int, char **, char **)
  {
    sigaction(SIGHUP, nullptr, &at_hang_up);
    refuse_without_room_for_blas();
  }

  [[gnu::used, gnu::section(".preinit_array")]] void (*const before_libraries)(int, char **, char **) = before_libraries_begin;

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
