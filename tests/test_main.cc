// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/lone_process.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

namespace
{
  /// Variables for a process that is no rank are there only while MPI starts, or programs that a test starts on several ranks have them.
  std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> start_mpi(const int argc, char **&argv)
  {
    const bool rank = myolines::is_rank_of_a_job();
    if (!rank)
      for (const auto &[name, value] : myolines::lone_process_variables)
        setenv(name, value, 1);
    int  name_alone = std::min(argc, 1); // PETSc, where deal.II starts it, takes options for its own
    auto mpi        = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(name_alone, argv, 1);
    if (!rank)
      for (const auto &[name, value] : myolines::lone_process_variables)
        unsetenv(name);
    return mpi;
  }
} // namespace

int main(int argc, char **argv)
{
  const auto mpi = start_mpi(argc, argv);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
