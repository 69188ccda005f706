// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs commands of the program in which one call of the system fails, for faults.py: fault_program [started].
//
// A request on standard input is a packet of texts that end with a zero: the number of the call that fails (0: none), errno (0: the process
// is killed), "once" or "lasting", after how many microseconds the process is killed (0: never), a folder, the words of the command. The
// answer is what waitpid() gave; the calls are in the file calls.txt of the folder. With the word "started", MPI is started once, before
// all commands; studies need it not to be.

#include "../support/loaded_program.h"
#include "../support/places.h"
#include "faulty_calls.h"

#include <myolines/cli/mpi_session.h>
#include <myolines/cli/program.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
  constexpr unsigned int longest = 60; ///< a command [s]

  struct Request
  {
    explicit Request(const std::vector<std::string> &texts)
      : fault{std::stol(texts.at(0)), std::stoi(texts.at(1)), texts.at(2) == "lasting"}
      , killed_after(static_cast<useconds_t>(std::stoul(texts.at(3))))
      , folder(texts.at(4))
      , words(texts.begin() + 5, texts.end())
    {}

    myolines::test::Fault    fault;
    useconds_t               killed_after; ///< [1e-6 s]
    std::string              folder;
    std::vector<std::string> words;
  };

  [[noreturn]] void run(Request request, myolines::MpiSession &mpi, myolines::test::CallList &calls)
  {
    if (chdir(request.folder.c_str()) != 0)
      _exit(127);
    myolines::test::redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
    myolines::test::redirect(STDOUT_FILENO, "out.txt", O_WRONLY | O_CREAT | O_TRUNC);
    myolines::test::redirect(STDERR_FILENO, "err.txt", O_WRONLY | O_CREAT | O_TRUNC);
    request.words.insert(request.words.begin(), myolines::test::program_file());
    alarm(longest);
    myolines::test::watch_calls(request.folder, calls, request.fault);
    const int code = myolines::program(static_cast<int>(request.words.size()), myolines::test::pointers(request.words).data(), mpi);
    std::cout.flush();
    std::fflush(nullptr);
    _exit(code); // the libraries of the parent end with it
  }

  int status_of(const Request &request, myolines::MpiSession &mpi, myolines::test::CallList &calls)
  {
    calls.clear();
    const pid_t process = fork();
    if (process == 0)
      run(request, mpi, calls);
    if (request.killed_after > 0)
      {
        usleep(request.killed_after);
        kill(process, SIGKILL);
      }
    int status = -1;
    waitpid(process, &status, 0);
    std::ofstream(request.folder + "/calls.txt") << calls.text();
    return status;
  }
} // namespace

int main(int argc, char **argv)
{
  myolines::MpiSession mpi(argc, argv);
  if (argc > 1 && std::string(argv[1]) != "started") // a study has started a rank
    return myolines::program(argc, argv, mpi);
  if (argc > 1)
    mpi.start();
  myolines::test::CallList calls;
  std::vector<char>        buffer(1 << 16);
  for (ssize_t size; (size = recv(STDIN_FILENO, buffer.data(), buffer.size(), 0)) > 0;)
    {
      const Request request(myolines::test::ended_by_zeros(std::string(buffer.data(), static_cast<std::size_t>(size))));
      const int     status = status_of(request, mpi, calls);
      if (send(STDIN_FILENO, &status, sizeof status, MSG_NOSIGNAL) != static_cast<ssize_t>(sizeof status))
        return 1;
    }
}
