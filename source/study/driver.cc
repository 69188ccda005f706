// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/study/driver.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <thread>

namespace myolines::study
{
  RunnerOptions runner_options(const Driver &driver, const Study &study, const std::filesystem::path &folder)
  {
    RunnerOptions runner;
    runner.program     = driver.program;
    runner.plugins     = driver.plugins;
    runner.run_in_copy = driver.run_in_copy;
    runner.folder      = folder;
    runner.jobs        = driver.jobs > 0 ? driver.jobs : std::max(1u, std::thread::hardware_concurrency() / study.ranks);
    runner.retry       = driver.retry;
    runner.resolve     = [&driver, &study](const Case &which) { return driver.resolve(study.scene, which.settings); };
    if (driver.fitting_jobs)
      runner.fitting_jobs = [&driver, &study](const unsigned int jobs) { return driver.fitting_jobs(jobs, study.ranks, driver.jobs > 0); };
    runner.stop_signal = driver.stop_signal;
    runner.terminal    = driver.terminal;
    return runner;
  }

  void throw_if_open(const RunnerReport &report)
  {
    if (!report.why_open.empty())
      throw Interrupted("stopped: " + report.why_open + "; " + std::to_string(report.n_open) +
                        " cases are open. The same command goes on with them");
  }

  void require_one_process(const std::string &name, const std::string &hint)
  {
    if (dealii::Utilities::MPI::job_supports_mpi() && dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      throw InputError(
          InputProblem{"mpirun", "\"" + name + "\" is started as one process, which starts the runs", "myolines " + name + " ...", hint});
  }
} // namespace myolines::study
