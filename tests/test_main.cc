#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <utility>

namespace
{
  /// Under these Open MPI starts no helper daemon for a process that is no rank of a job.
  constexpr std::pair<const char *, const char *> alone[] = {{"OMPI_MCA_ess_singleton_isolated", "1"},
                                                             {"OMPI_MCA_orte_create_session_dirs", "0"},
                                                             {"OMPI_MCA_pml", "ob1"},
                                                             {"OMPI_MCA_btl", "self"}};

  std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> start_mpi(int &argc, char **&argv)
  {
    const bool rank = std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMIX_RANK") != nullptr;
    if (!rank)
      for (const auto &[name, value] : alone)
        setenv(name, value, 1);
    auto mpi = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(argc, argv, 1);
    if (!rank)
      for (const auto &[name, value] : alone)
        unsetenv(name); // or programs that a test starts on several ranks have them
    return mpi;
  }
} // namespace

int main(int argc, char **argv)
{
  const auto mpi = start_mpi(argc, argv);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
