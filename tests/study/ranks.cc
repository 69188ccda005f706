// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/places.h"
#include "study_files.h"

#include <myolines/study/csv_table.h>
#include <myolines/study/database.h>
#include <myolines/study/processes.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

using namespace myolines::study;
using namespace myolines::testing;

// Studies whose runs, or whose parts, are jobs of mpirun.

namespace
{
  const std::string steps = listed("step", "time/step", "0.1 | 0.05 | 0.025");

  /// What mpirun needs where the tests run: as root in a container, on few cores.
  const std::vector<std::string> permissions{"/usr/bin/env",
                                             "OMPI_ALLOW_RUN_AS_ROOT=1",
                                             "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                                             "OMPI_MCA_rmaps_base_oversubscribe=1",
                                             "PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe",
                                             "OMPI_MCA_mpi_yield_when_idle=1"};

  /// Starts @p command, not through a shell of this process, whose MPI library has set variables that mpirun would heed.
  pid_t start(Processes &processes, const StudyFolder &folder, const std::vector<std::string> &command)
  {
    std::vector<std::string> words = permissions;
    words.insert(words.end(), command.begin(), command.end());
    return processes.start(words, folder / "console");
  }

  int exit_code(const StudyFolder &folder, const std::vector<std::string> &command)
  {
    Processes processes;
    start(processes, folder, command);
    std::vector<Ended> ended;
    while (ended.empty())
      ended = processes.wait(1);
    return ended.front().exit_code;
  }

  std::vector<std::string> study(const StudyFolder &folder, const std::string &out, const std::vector<std::string> &more = {})
  {
    std::vector<std::string> words{myolines::test::program_file(), "study", (folder / "study.xml").string(), "--out",
                                   (folder / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// Processes that have @p word among their arguments.
  std::size_t n_processes(const std::string &word)
  {
    std::size_t n = 0;
    for (const auto &entry : std::filesystem::directory_iterator("/proc"))
      if (contents(entry.path() / "cmdline").find(word) != std::string::npos)
        ++n;
    return n;
  }

  /// 64 cells of muscle, which two ranks share, in an isometric contraction of some steps.
  void write_muscle_study(const StudyFolder &folder, const std::string &more_settings = "")
  {
    folder.write("scene.xml", contents(myolines::test::source_folder() + "/input/isometric_block.xml"));
    const std::string force      = section("force", parameter("file", "reaction.csv") + parameter("column", "moving end x [N]") +
                                                        parameter("measure", "final")),
                      iterations = section("iterations", parameter("type", "count") + parameter("name", "newton iterations"));
    folder.write_study(grid("all", listed("step", "time/step", "0.2 | 0.1")),
                       parameter("settings", "system/geometry/refinement=2 | time/control/type=fixed" + more_settings) +
                           section("quantities", force + iterations));
  }
} // namespace

TEST(StudyRanks, PartsOfOneJobAreTakenTogether)
{
  const StudyFolder folder;
  folder.write_study(grid("all", steps), section("quantities", error_against_cosine()));
  ASSERT_EQ(exit_code(folder, study(folder, "ranks", {"--emit", "mpi", "--tasks", "2"})), 0);
  ASSERT_EQ(exit_code(folder, {"bash", (folder / "ranks/study.mpi.sh").string()}), 0) << contents(folder / "console");
  const std::string log = contents(folder / "ranks/study.log");
  EXPECT_NE(log.find("2 cases, 0 of them known"), std::string::npos) << log;
  EXPECT_NE(log.find("3 cases, 3 of them known"), std::string::npos) << log;
  ASSERT_EQ(exit_code(folder, study(folder, "alone")), 0);
  EXPECT_EQ(contents(folder / "ranks/study.csv"), contents(folder / "alone/study.csv"));
}

/// Runs of two ranks, two groups of two ranks in one job, and an array of two tasks of two ranks: all have the table of runs of one
/// rank, to the tolerance of the solvers.
TEST(StudyRanks, GroupsOfRanksShareACase)
{
  const StudyFolder folder;
  write_muscle_study(folder);
  const std::vector<std::string> two{"--set", "ranks=2"};
  ASSERT_EQ(exit_code(folder, study(folder, "one")), 0) << contents(folder / "console");
  ASSERT_EQ(exit_code(folder, study(folder, "two", two)), 0) << contents(folder / "console");

  ASSERT_EQ(exit_code(folder, study(folder, "mpi", {"--set", "ranks=2", "--emit", "mpi", "--tasks", "2"})), 0);
  ASSERT_EQ(exit_code(folder, {"bash", (folder / "mpi/study.mpi.sh").string()}), 0) << contents(folder / "console");
  const std::string log = contents(folder / "mpi/study.log");
  EXPECT_NE(log.find("1 case, 0 of them known"), std::string::npos) << log;
  EXPECT_NE(log.find("2 cases, 2 of them known"), std::string::npos) << log;

  ASSERT_EQ(exit_code(folder, study(folder, "slurm", {"--set", "ranks=2", "--emit", "slurm", "--tasks", "2"})), 0);
  const std::string script = (folder / "slurm/study.slurm.sh").string();
  EXPECT_NE(contents(script).find("#SBATCH --ntasks=2\n"), std::string::npos);
  for (const char *task : {"1", "2"})
    ASSERT_EQ(exit_code(folder, {"SLURM_ARRAY_TASK_ID=" + std::string(task), "bash", script}), 0) << contents(folder / "console");
  ASSERT_EQ(exit_code(folder, {"bash", script, "collect"}), 0) << contents(folder / "console");

  const auto rows     = [&folder](const std::string &out) { return read_csv(folder / (out + "/study.csv"))->rows; };
  const auto expected = rows("one");
  ASSERT_EQ(expected.size(), 2u);
  for (const char *out : {"two", "mpi", "slurm"})
    {
      const auto found = rows(out);
      ASSERT_EQ(found.size(), 2u) << out;
      for (std::size_t i = 0; i < 2; ++i)
        {
          EXPECT_EQ(found[i][0], expected[i][0]) << out; // its name
          EXPECT_EQ(found[i][3], "done") << out;
          EXPECT_NEAR(std::stod(found[i][5]) / std::stod(expected[i][5]), 1, 1e-8) << out; // the force
        }
    }
  for (auto &[name, outcome] : Database(folder / "mpi/study.sqlite").outcomes())
    {
      EXPECT_NE(outcome.manifest.find("\"ranks\": 2"), std::string::npos) << outcome.manifest;
      EXPECT_GT(outcome.cpu_seconds.value(), 0.1) << "of the ranks too";
    }
}

/// No rank outlives a study that was killed, and what was done is not done again.
TEST(StudyRanks, DieWithTheStudy)
{
  const StudyFolder folder;
  write_muscle_study(folder, " | time/end=1000 | system/activation/points=0 0; 1000 0");
  const std::string case_name = (folder / "killed/cases/step=0.2").string();
  {
    Processes   processes;
    const pid_t driver = start(processes, folder, study(folder, "killed", {"--set", "ranks=2", "--jobs", "1"}));
    while (n_processes(case_name) < 2 || !std::filesystem::exists(case_name + "/steps.csv"))
      ASSERT_TRUE(processes.wait(0.05).empty()) << contents(folder / "console");
    processes.send(driver, SIGKILL);
    ASSERT_EQ(processes.wait(10).size(), 1u);
  }
  for (int i = 0; i < 100 && n_processes(case_name) > 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(n_processes(case_name), 0u);
}

/// What ended a run of several ranks is told as it is of one: a time-out here, for which the ranks get the time to save their state.
TEST(StudyRanks, TimeOutIsARow)
{
  const StudyFolder folder;
  write_muscle_study(folder, " | time/end=1000 | system/activation/points=0 0; 1000 0");
  const std::vector<std::string> settings{"--set", "ranks=2", "--set", "budget/case=10", "--set", "grids/all/step/values=0.1"};
  ASSERT_EQ(exit_code(folder, study(folder, "late", settings)), 0) << contents(folder / "console");
  for (auto &[name, outcome] : Database(folder / "late/study.sqlite").outcomes())
    {
      EXPECT_EQ(outcome.status, "timed out") << name;
      EXPECT_TRUE(std::filesystem::exists(folder / "late/cases" / name / "checkpoint"));
      EXPECT_NE(outcome.manifest.find("asked to stop by the signal"), std::string::npos) << outcome.manifest;
    }
}
