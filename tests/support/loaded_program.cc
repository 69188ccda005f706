// SPDX-License-Identifier: LGPL-2.1-or-later
#include "loaded_program.h"

#include "places.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

namespace myolines::test
{
  namespace
  {
    /// The environment with which this process began, before MPI said in it that it is a rank of a job.
    std::vector<std::string> environment_at_start()
    {
      std::ostringstream text;
      text << std::ifstream("/proc/self/environ").rdbuf();
      return ended_by_zeros(text.str());
    }
  } // namespace

  LoadedProgram::LoadedProgram()
  {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
      throw std::runtime_error(std::string("socketpair: ") + std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    const std::string        file = loaded_program_file();
    std::vector<std::string> words{file}, variables = environment_at_start();
    const int failed = posix_spawn(&process_, file.c_str(), &actions, nullptr, pointers(words).data(), pointers(variables).data());
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    socket_ = ends[0];
    if (failed != 0)
      throw std::runtime_error("cannot start " + file + " (a target of the build): " + std::strerror(failed));
  }

  LoadedProgram::~LoadedProgram()
  {
    close(socket_); // the process ends when nobody can ask any more
    waitpid(process_, nullptr, 0);
  }

  int LoadedProgram::run(const std::filesystem::path &folder, const std::vector<std::string> &arguments) const
  {
    std::string request = folder.string() + '\0';
    for (const std::string &argument : arguments)
      request += argument + '\0';
    int status = 0;
    if (send(socket_, request.data(), request.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(request.size()) ||
        recv(socket_, &status, sizeof status, 0) != static_cast<ssize_t>(sizeof status))
      throw std::runtime_error("the loaded program does not answer");
    return status;
  }

  std::vector<char *> pointers(std::vector<std::string> &texts)
  {
    std::vector<char *> all;
    for (std::string &text : texts)
      all.push_back(text.data());
    all.push_back(nullptr);
    return all;
  }

  void redirect(const int stream, const char *file, const int flags)
  {
    const int opened = open(file, flags | O_CLOEXEC, 0666);
    if (opened < 0 || dup2(opened, stream) < 0)
      _exit(127);
    close(opened);
  }

  std::vector<std::string> ended_by_zeros(const std::string &text)
  {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin < text.size();)
      {
        const std::size_t end = text.find('\0', begin);
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
      }
    return parts;
  }

  std::vector<std::string> shell_words(const std::string &line)
  {
    wordexp_t                expanded{};
    std::vector<std::string> words;
    if (wordexp(line.c_str(), &expanded, WRDE_NOCMD) == 0)
      {
        words.assign(expanded.we_wordv, expanded.we_wordv + expanded.we_wordc);
        wordfree(&expanded);
      }
    return words;
  }
} // namespace myolines::test
