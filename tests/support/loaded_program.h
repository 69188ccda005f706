// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myolines::test
{
  /// The program `myolines`, loaded once: half a second of dynamic loading is most of what a small command costs. A process of its own
  /// (`tests/support/loaded_program_main.cc`) has the libraries and has not started MPI; each command runs in a copy of it, so that no
  /// command sees anything of another.
  class LoadedProgram
  {
  public:
    LoadedProgram();
    ~LoadedProgram();
    LoadedProgram(const LoadedProgram &)            = delete;
    LoadedProgram &operator=(const LoadedProgram &) = delete;

    /// Runs the program with @p arguments in @p folder; its streams become out.txt and err.txt there.
    /// Returns the status that `waitpid` gives. Throws std::runtime_error where the process does not answer.
    int run(const std::filesystem::path &folder, const std::vector<std::string> &arguments) const;

  private:
    int socket_  = -1;
    int process_ = -1;
  };

  // Of processes that run the program.

  /// What main() gets of @p texts, which it borrows; the last one is null.
  std::vector<char *> pointers(std::vector<std::string> &texts);

  /// Opens @p file as @p stream of this process, or ends it with code 127.
  void redirect(int stream, const char *file, int flags);

  /// The parts of @p text, each of which ends with a zero.
  std::vector<std::string> ended_by_zeros(const std::string &text);

  /// The words of a command line as the shell divides them; empty where the line asks for more than words (redirections, several commands).
  std::vector<std::string> shell_words(const std::string &line);
} // namespace myolines::test
