// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/places.h"
#include "study_files.h"

#include <myolines/study/csv_table.h>
#include <myolines/study/processes.h>

#include <gtest/gtest.h>

using namespace myolines::study;
using namespace myolines::testing;

// The command `study` of the program itself, on oscillations that take milliseconds.

namespace
{
  const std::string methods = groups("method", {{"be", "integrator/type=backward euler"}, {"nm", "integrator/type=newmark"}});
  const std::string steps   = listed("step", "time/step", "0.1 | 0.05 | 0.025");
  const std::string error   = section("quantities", error_against_cosine());

  std::size_t count(const std::string &text, const std::string &what)
  {
    std::size_t n = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
      ++n;
    return n;
  }

  /// Starts the study in the folder `killed`, one case after the other so that some are left, and ends it with @p signal when @p n cases
  /// are in its log. Its exit code, -1 if killed.
  int interrupt(const StudyFolder &folder, const std::size_t n, const int signal)
  {
    Processes   processes;
    const pid_t driver = processes.start(
        {myolines::test::program_file(), "study", (folder / "study.xml").string(), "--out", (folder / "killed").string(), "--jobs", "1"},
        folder / "console");
    std::vector<Ended> ended;
    while (ended.empty() && count(contents(folder / "killed/study.log"), "  done  ") < n)
      ended = processes.wait(0.005);
    if (ended.empty())
      processes.send(driver, signal);
    while (ended.empty())
      ended = processes.wait(1);
    return ended.front().exit_code;
  }
} // namespace

/// Backward Euler is of first order and the trapezoidal rule of second: the study finds the rates.
TEST(StudyProgram, MeasuresRatesInTime)
{
  const StudyFolder folder;
  folder.write_study(grid("all", methods + steps),
                     parameter("kind", "convergence") + parameter("curves", "method") + parameter("sizes", "step") + error);
  const ::Outcome outcome = run_program(folder, "study study.xml --out out --jobs 2");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("6 cases: 6 done"), std::string::npos) << outcome.out;
  const auto table = read_csv(folder / "out/study.csv");
  ASSERT_TRUE(table.has_value());
  const auto rate = table->column("rate of error in u");
  ASSERT_TRUE(rate.has_value());
  EXPECT_NEAR(std::stod(table->rows[2][*rate]), 1, 0.05);
  EXPECT_NEAR(std::stod(table->rows[5][*rate]), 2, 0.05);

  EXPECT_EQ(run_program(folder, "plot out").out.substr(0, 10), "1 picture,");
  for (const char *name : {"png", "svg", "gp"})
    EXPECT_GT(std::filesystem::file_size(folder / ("out/pictures/error_in_u_over_step." + std::string(name))), 300u) << name;
}

/// Killed three times, once gently: the table is that of a study left alone, and no case was done twice.
TEST(StudyProgram, KilledAndRunAgainGivesTheSameTable)
{
  const StudyFolder folder;
  folder.write_study(grid("all", methods + listed("step", "time/step", "0.1 | 0.05 | 0.025")), error);
  EXPECT_EQ(interrupt(folder, 1, SIGKILL), -1);
  EXPECT_EQ(interrupt(folder, 2, SIGTERM), 3);
  EXPECT_EQ(interrupt(folder, 4, SIGKILL), -1);
  ASSERT_EQ(run_program(folder, "study study.xml --out killed").exit_code, 0);
  ASSERT_EQ(run_program(folder, "study study.xml --out alone").exit_code, 0);
  EXPECT_EQ(contents(folder / "killed/study.csv"), contents(folder / "alone/study.csv"));
  EXPECT_EQ(count(contents(folder / "alone/study.csv"), ",done,"), 6u);
  EXPECT_EQ(count(contents(folder / "killed/study.log"), "  done  "), 6u);
  EXPECT_LE(count(contents(folder / "killed/study.log"), "6 cases, 0 of them known"), 1u);
}

/// Repeats change nothing but seconds.csv, which has medians and spreads then; a name that repeats would take is refused.
TEST(StudyProgram, RepeatsHaveMedianAndSpread)
{
  const StudyFolder folder;
  folder.write_study(grid("all", methods + steps), error);
  ASSERT_EQ(run_program(folder, "study study.xml --out once").exit_code, 0);
  const ::Outcome outcome = run_program(folder, "study study.xml --out out --set repeats=3");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("6 cases: 6 done"), std::string::npos) << outcome.out;
  EXPECT_EQ(count(contents(folder / "out/study.log"), "  done  "), 18u);
  EXPECT_EQ(contents(folder / "out/study.csv"), contents(folder / "once/study.csv"));
  const auto seconds = read_csv(folder / "out/seconds.csv");
  ASSERT_EQ(seconds->rows.size(), 6u);
  const auto number = [&](const std::size_t row, const std::string &column) {
    return std::stod(seconds->rows[row][seconds->column(column).value()]);
  };
  for (std::size_t row = 0; row < 6; ++row)
    {
      EXPECT_EQ(number(row, "runs"), 3);
      EXPECT_GT(number(row, "CPU [s]"), 0);
      EXPECT_GT(number(row, "spread of wall clock [s]"), 0);
    }
  EXPECT_FALSE(read_csv(folder / "once/seconds.csv")->column("runs").has_value());
  EXPECT_EQ(run_program(folder, "plot out").exit_code, 0);

  folder.write_study(grid("all", steps) + grid("others", listed("step", "time/step", "0.1") + groups("repeat", {{"2", "system/mass=2"}})));
  const ::Outcome refused = run_program(folder, "study study.xml --out twice --set repeats=2");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("step=0.1,repeat=2"), std::string::npos) << refused.err;
}

TEST(StudyProgram, PartsAreTakenTogether)
{
  const StudyFolder folder;
  folder.write_study(grid("all", steps), error);
  ASSERT_EQ(run_program(folder, "study study.xml --out parts --emit slurm --tasks 2").exit_code, 0);
  for (const char *task : {"1", "2"})
    ASSERT_EQ(
        std::system(("SLURM_ARRAY_TASK_ID=" + std::string(task) + " bash '" + (folder / "parts/study.slurm.sh").string() + "'").c_str()),
        0);
  EXPECT_FALSE(std::filesystem::exists(folder / "parts/study.csv"));
  ASSERT_EQ(std::system(("bash '" + (folder / "parts/study.slurm.sh").string() + "' collect > /dev/null").c_str()), 0);
  EXPECT_NE(contents(folder / "parts/study.log").find("3 cases, 3 of them known"), std::string::npos);
  ASSERT_EQ(run_program(folder, "study study.xml --out whole").exit_code, 0);
  EXPECT_EQ(contents(folder / "parts/study.csv"), contents(folder / "whole/study.csv"));
  EXPECT_EQ(run_program(folder, "study study.xml --out parts --part 3/2").exit_code, 2);
  EXPECT_EQ(run_program(folder, "study study.xml --out parts --part 1/2 --emit slurm").exit_code, 2);
}

/// A finer run as reference and another method beside it: their difference is told.
TEST(StudyProgram, ReferenceIsCrossChecked)
{
  const StudyFolder folder;
  const std::string of_state = section("quantities", section("state", parameter("type", "state")));
  folder.write_study(
      grid("all", steps),
      section("reference", parameter("settings", "integrator/type=sdirk3 | time/step=0.0125") + parameter("instead of", "step")) +
          section("cross check", parameter("settings", "integrator/type=sdirk2 | time/step=0.0125") + parameter("instead of", "step")) +
          of_state);
  const ::Outcome outcome = run_program(folder, "study study.xml --out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Reference and cross check differ: state = "), std::string::npos) << outcome.out;
  const auto table = read_csv(folder / "out/study.csv");
  const auto state = table->column("state");
  EXPECT_EQ(table->rows[0][*state], "");
  EXPECT_LT(std::stod(table->rows[1][*state]), 1e-4);
  // backward Euler damps cos(1) by exp(-h/2)
  EXPECT_NEAR(std::stod(table->rows[4][*state]) / std::stod(table->rows[3][*state]), 0.5, 0.03);
}

/// Fields of runs on other meshes than that of the reference: the linear rod of degree p converges with order p + 1 in L2, and so it does
/// when the steps of a method of second order are halved along with elements of degree 1.
TEST(StudyProgram, MeasuresRatesOfFieldsInSpaceAndInBoth)
{
  const StudyFolder folder;
  folder.write("scene.xml", contents(myolines::test::source_folder() + "/input/rod_linear.xml"));
  const std::string elements = groups("size", {{"0.125", "system/elements=4"}, {"0.0625", "system/elements=8"}});
  const auto        quantity = [](const std::string &field) { return section(field, parameter("type", "field") + parameter("of", field)); };
  const std::string halved   = listed("step", "time/step", "0.01 | 0.005", parameter("zipped with", "size"));
  folder.write_study(grid("space", listed("degree", "system/degree", "1 | 2") + elements) +
                         grid("both", groups("degree", {{"both", "system/degree=1"}}) + elements + halved),
                     parameter("kind", "convergence") + parameter("curves", "degree") + parameter("sizes", "size") +
                         section("reference", parameter("settings", "system/degree=3 | system/elements=24") +
                                                  parameter("instead of", "degree | size | step")) +
                         section("quantities", quantity("displacement") + quantity("pressure")));
  const ::Outcome outcome = run_program(folder, "study study.xml --out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto table = read_csv(folder / "out/study.csv");
  const auto rate = table->column("rate of displacement"), notes = table->column("notes");
  ASSERT_EQ(table->rows.size(), 7u);
  EXPECT_NEAR(std::stod(table->rows[2][*rate]), 2, 0.05);
  EXPECT_NEAR(std::stod(table->rows[4][*rate]), 3, 0.1);
  EXPECT_NEAR(std::stod(table->rows[6][*rate]), 2, 0.05);
  EXPECT_EQ(table->rows[1][*notes], "pressure: the system has no pressure");
}

/// What was misspelt is told on the terminal, not only in a cell of the table; pictures of nothing are refused.
TEST(StudyProgram, QuantitiesWithoutAValueAreTold)
{
  const StudyFolder folder;
  const auto        of = [](const std::string &file, const std::string &column) {
    return section(file + column, parameter("file", file) + parameter("column", column) + parameter("measure", "final"));
  };
  folder.write_study(grid("all", listed("step", "time/step", "0.1 | 0.05")),
                     section("quantities", of("trajectory.csv", "Displacment [m]") + of("trajectry.csv", "Displacement [m]")));
  const ::Outcome outcome = run_program(folder, "study study.xml --out out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("nearest: \"Displacement [m]\""), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("nearest: \"trajectory.csv\""), std::string::npos) << outcome.out;
  const ::Outcome plot = run_program(folder, "plot out");
  EXPECT_EQ(plot.exit_code, 2);
  EXPECT_NE(plot.err.find("there is nothing to draw"), std::string::npos) << plot.err;
}

TEST(StudyProgram, BadInputIsToldBeforeAnythingRuns)
{
  const StudyFolder folder;
  folder.write_study(grid("all", listed("step", "time/stp", "0.1 | 0.05")), error);
  const ::Outcome outcome = run_program(folder, "study study.xml --out out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("\"step\""), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/cases"));
  EXPECT_EQ(run_program(folder, "plot out").exit_code, 2);
  EXPECT_EQ(run_program(folder, "study scene.xml").exit_code, 2);
}
