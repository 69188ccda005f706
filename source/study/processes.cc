// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/study/processes.h>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace myolines::study
{
  namespace
  {
    /// With these a run would take itself for a rank of the job that started this program.
    bool is_of_mpi(const std::string &variable)
    {
      for (const char *prefix :
           {"OMPI_COMM_", "OMPI_UNIVERSE", "OMPI_MCA_ess", "OMPI_MCA_orte", "OMPI_MCA_pmix", "PMIX_", "PMI_", "ORTE_", "PRTE_LAUNCHED"})
        if (variable.rfind(prefix, 0) == 0)
          return true;
      return false;
    }

    /// As the kernel keeps it: what this process, its MPI library for one, has set since is not there.
    std::vector<std::string> environment_at_start()
    {
      std::ifstream      file("/proc/self/environ", std::ios::binary);
      std::ostringstream text;
      text << file.rdbuf();
      std::istringstream       entries(text.str());
      std::vector<std::string> variables;
      for (std::string variable; std::getline(entries, variable, '\0');)
        if (!is_of_mpi(variable))
          variables.push_back(variable);
      return variables;
    }

    std::vector<char *> pointers(std::vector<std::string> &texts)
    {
      std::vector<char *> all;
      for (std::string &text : texts)
        all.push_back(text.data());
      all.push_back(nullptr);
      return all;
    }

    /// What a child does first, between fork and exec: only calls that are safe there.
    void set_up_child(const int console, const pid_t parent, const sigset_t &signals)
    {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) // it died before the line above
        _exit(127);
      setpgid(0, 0);
      const int nothing = open("/dev/null", O_RDONLY);
      dup2(nothing, STDIN_FILENO);
      dup2(console, STDOUT_FILENO);
      dup2(console, STDERR_FILENO);
      close_range(STDERR_FILENO + 1, ~0u, 0); // locks and databases are the parent's
      sigprocmask(SIG_SETMASK, &signals, nullptr);
    }

    [[noreturn]] void run_and_end(const std::function<int()> &body)
    {
      const int exit_code = body();
      std::cout.flush();
      std::fflush(nullptr);
      _exit(exit_code); // no destructors of the parent's objects
    }

    double seconds(const timeval &time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); }
  } // namespace

  Processes::Processes()
  {
    sigset_t child;
    sigemptyset(&child);
    sigaddset(&child, SIGCHLD);
    sigprocmask(SIG_BLOCK, &child, &before_); // sigtimedwait() takes it
  }

  Processes::~Processes()
  {
    for (const pid_t process : alive_)
      kill(process, SIGKILL);
    for (const pid_t process : alive_)
      waitpid(process, nullptr, 0);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }

  pid_t Processes::start(const std::vector<std::string> &command, const std::filesystem::path &console)
  {
    std::vector<std::string> words = command, variables = environment_at_start();
    const auto               arguments = pointers(words), environment = pointers(variables);
    return fork_child(
        [&] {
          execve(arguments[0], arguments.data(), environment.data());
          _exit(127);
        },
        console);
  }

  pid_t Processes::start(const std::function<int()> &body, const std::filesystem::path &console)
  {
    std::cout.flush();
    std::fflush(nullptr); // or the child writes it again
    return fork_child([&] { run_and_end(body); }, console);
  }

  pid_t Processes::fork_child(const std::function<void()> &child, const std::filesystem::path &console)
  {
    const int file = open(console.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
      throw SystemError("write", console, errno);
    const pid_t parent  = getpid();
    const pid_t process = fork();
    if (process == 0)
      {
        set_up_child(file, parent, before_);
        child();
      }
    close(file);
    if (process < 0)
      throw SystemError(std::string("cannot start a process: ") + std::strerror(errno), errno);
    alive_.push_back(process);
    return process;
  }

  std::vector<Ended> Processes::wait(const double limit)
  {
    const auto reap = [this] {
      std::vector<Ended> ended;
      for (const pid_t process : std::vector<pid_t>(alive_))
        {
          int    status = 0;
          rusage usage{};
          if (wait4(process, &status, WNOHANG, &usage) != process)
            continue;
          Ended end;
          end.process     = process;
          end.exit_code   = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
          end.signal      = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
          end.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
          ended.push_back(end);
          alive_.erase(std::find(alive_.begin(), alive_.end(), process));
        }
      return ended;
    };
    std::vector<Ended> ended = reap();
    if (!ended.empty())
      return ended;
    sigset_t child;
    sigemptyset(&child);
    sigaddset(&child, SIGCHLD);
    timespec time{};
    time.tv_sec  = static_cast<time_t>(limit);
    time.tv_nsec = static_cast<long>(1e9 * (limit - std::floor(limit)));
    sigtimedwait(&child, nullptr, &time);
    return reap();
  }

  void Processes::send(const pid_t process, const int signal) const { kill(process, signal); }

  std::filesystem::path this_program() { return std::filesystem::read_symlink("/proc/self/exe"); }
} // namespace myolines::study
