// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs the commands that LoadedProgram asks for on standard input, each in a copy of this process.

#include "loaded_program.h"
#include "places.h"

#include <myolines/cli/mpi_session.h>
#include <myolines/cli/program.h>

#include <cstdlib>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
  int myolines_program(int argc, char **argv)
  {
    myolines::MpiSession mpi(argc, argv);
    return myolines::program(argc, argv, mpi);
  }

  [[noreturn]] void run(std::vector<std::string> words)
  {
    if (chdir(words[0].c_str()) != 0)
      _exit(127);
    myolines::test::redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
    myolines::test::redirect(STDOUT_FILENO, "out.txt", O_WRONLY | O_CREAT | O_TRUNC);
    myolines::test::redirect(STDERR_FILENO, "err.txt", O_WRONLY | O_CREAT | O_TRUNC);
    words[0] = myolines::test::program_file();
    std::exit(myolines_program(static_cast<int>(words.size()), myolines::test::pointers(words).data()));
  }
} // namespace

int main(int argc, char **argv)
{
  if (argc > 1) // a study has written a script or starts ranks: its program is this one
    return myolines_program(argc, argv);
  std::vector<char> buffer(1 << 16);
  for (ssize_t size; (size = recv(STDIN_FILENO, buffer.data(), buffer.size(), 0)) > 0;)
    {
      const std::vector<std::string> words   = myolines::test::ended_by_zeros(std::string(buffer.data(), static_cast<std::size_t>(size)));
      const pid_t                    process = fork();
      if (process == 0)
        run(words);
      int status = -1;
      if (process > 0)
        waitpid(process, &status, 0);
      if (send(STDIN_FILENO, &status, sizeof status, MSG_NOSIGNAL) != static_cast<ssize_t>(sizeof status))
        return 1;
    }
}
