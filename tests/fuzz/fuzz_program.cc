// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs one command after the other in a process that has started MPI once, for fuzz.py; where a command ends the process, another one goes
// on.
//
// A request on standard input is a packet of texts that end with a zero: a folder, then the words of the command. The answer is an int: the
// exit code, or 1000 and the signal that ended the process, or 2000 and the code with which it ended itself.

#include "../support/loaded_program.h"
#include "../support/places.h"

#include <myolines/cli/mpi_session.h>
#include <myolines/cli/program.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
  constexpr unsigned int longest = 20;              ///< a command [s]
  constexpr rlim_t       largest = rlim_t(4) << 30; ///< of a process, of which libraries take one [bytes]

  void answer(const int code)
  {
    if (send(STDIN_FILENO, &code, sizeof code, MSG_NOSIGNAL) != static_cast<ssize_t>(sizeof code))
      _exit(1);
  }

  int run(std::vector<std::string> words, myolines::MpiSession &mpi)
  {
    if (chdir(words[0].c_str()) != 0)
      _exit(1);
    myolines::test::redirect(STDOUT_FILENO, "out.txt", O_WRONLY | O_CREAT | O_TRUNC);
    myolines::test::redirect(STDERR_FILENO, "err.txt", O_WRONLY | O_CREAT | O_TRUNC);
    words[0] = myolines::test::program_file();
    alarm(longest);
    const int code = myolines::program(static_cast<int>(words.size()), myolines::test::pointers(words).data(), mpi);
    alarm(0);
    std::cout.flush();
    std::fflush(nullptr);
    return code;
  }

  /// Until nobody asks any more.
  void serve(int argc, char **argv)
  {
    const rlimit limit{largest, largest}, no_core{0, 0};
    if (std::getenv("ASAN_OPTIONS") == nullptr) // which takes terabytes of addresses and watches over memory itself
      setrlimit(RLIMIT_AS, &limit);
    setrlimit(RLIMIT_CORE, &no_core);
    myolines::MpiSession mpi(argc, argv);
    mpi.start();
    std::vector<char> buffer(1 << 16);
    for (ssize_t size; (size = recv(STDIN_FILENO, buffer.data(), buffer.size(), 0)) > 0;)
      answer(run(myolines::test::ended_by_zeros(std::string(buffer.data(), static_cast<std::size_t>(size))), mpi));
  }
} // namespace

int main(int argc, char **argv)
{
  if (argc > 1) // a case of a study
    {
      myolines::MpiSession mpi(argc, argv);
      return myolines::program(argc, argv, mpi);
    }
  while (true)
    {
      const pid_t process = fork();
      if (process == 0)
        {
          serve(argc, argv);
          return 0;
        }
      int status = 0;
      waitpid(process, &status, 0);
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return 0;
      answer(WIFSIGNALED(status) ? 1000 + WTERMSIG(status) : 2000 + WEXITSTATUS(status));
    }
}
