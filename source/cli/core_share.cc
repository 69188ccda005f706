// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/cli/core_share.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cmath>
#include <ctime>

namespace myolines
{
  namespace
  {
    double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

    /// CPU time over wall clock while this rank computes.
    double share_of_a_core()
    {
      using Clock      = std::chrono::steady_clock;
      const auto begin = Clock::now();
      const auto wall  = [&begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
      const auto cpu   = cpu_seconds();
      while (wall() < 0.06)
        ;
      return (cpu_seconds() - cpu) / wall();
    }
  } // namespace

  std::optional<std::string> warning_of_shared_cores()
  {
    const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    if (ranks == 1)
      return {};
    MPI_Barrier(MPI_COMM_WORLD);
    const double least = dealii::Utilities::MPI::min(share_of_a_core(), MPI_COMM_WORLD);
    if (least > 0.75)
      return {};
    return "a rank gets " + std::to_string(std::lround(100 * least)) + " % of a core: " + std::to_string(ranks) +
           " ranks share their cores with each other or with other programs, and ranks that wait spin, which can make the run ten times as "
           "long; start no more ranks than there are free cores";
  }
} // namespace myolines
