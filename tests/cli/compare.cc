// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: `myolines compare` of real runs, and what it refuses.

#include "program_runner.h"
#include "ranks.h"
#include "small_scenes.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace
{
  class Compare : public ::testing::Test
  {
  protected:
    Compare()
    {
      folder.write("muscle.xml", muscle_scene);
      folder.write("oscillator.xml", oscillator_scene);
    }

    void run(const std::string &scene, const std::string &out, const std::string &settings = "")
    {
      const Outcome outcome = run_program(folder, "run " + scene + " --quiet --out " + out + settings);
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }

    /// Rows of the table that `compare` writes, header first.
    std::vector<std::vector<std::string>> compare(const std::string &arguments)
    {
      const Outcome outcome = run_program(folder, "compare " + arguments + " --csv table.csv");
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      std::vector<std::vector<std::string>> rows;
      std::istringstream                    lines(contents(folder / "table.csv"));
      for (std::string line; std::getline(lines, line);)
        {
          rows.emplace_back();
          std::istringstream cells(line + ",end");
          for (std::string cell; std::getline(cells, cell, ',');)
            rows.back().push_back(cell);
        }
      return rows;
    }

    void expect_refused(const std::string &arguments, const std::string &what)
    {
      const Outcome outcome = run_program(folder, "compare " + arguments);
      EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
      EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
    }

    TestFolder folder;
  };

  const std::string keep = " --set output/checkpoint/keep/every=1";
} // namespace

TEST_F(Compare, ARunWithItselfAndWithOthers)
{
  run("muscle.xml", "one");
  run("muscle.xml", "finer", " --set system/geometry/refinement=1");
  run("muscle.xml", "cubic", " --set system/discretisation/degree=3 --set \"system/geometry/cells x=2\"");
  const auto same = compare("one one");
  ASSERT_EQ(same.size(), 5u);
  const std::vector<std::string> header{
      "Time [s]", "field", "unit of norms", "norm of first", "norm of second", "norm of difference", "relative difference", "end"};
  EXPECT_EQ(same[0], header);
  for (std::size_t f = 1; f < 5; ++f)
    {
      EXPECT_EQ(same[f][5], "0") << same[f][1];
      EXPECT_EQ(same[f][6], "0") << same[f][1];
    }
  for (const char *other : {"finer", "cubic"})
    {
      const auto rows = compare("one " + std::string(other)), back = compare(std::string(other) + " one");
      for (std::size_t f = 1; f < 5; ++f)
        {
          EXPECT_EQ(rows[f][5], back[f][5]) << rows[f][1];
          EXPECT_EQ(rows[f][3], back[f][4]) << rows[f][1];
        }
      const double e = std::stod(rows[1][6]);
      EXPECT_GT(e, 1e-5);
      EXPECT_LT(e, 0.1);
    }
}

/// The table of one rank and of two, of runs of one rank and of two.
TEST_F(Compare, Ranks)
{
  run("muscle.xml", "one");
  run("muscle.xml", "finer", " --set system/geometry/refinement=1");
  const auto alone  = compare("one finer");
  const auto mpirun = [this](const std::string &arguments) { return run_program(folder, arguments, on_ranks(2)).exit_code; };
  ASSERT_EQ(mpirun("run muscle.xml --quiet --out shared --set system/geometry/refinement=1"), 0) << contents(folder / "err.txt");
  ASSERT_EQ(mpirun("compare one shared --csv two.csv"), 0) << contents(folder / "err.txt");
  const std::string  table = contents(folder / "two.csv");
  std::istringstream lines(table);
  std::string        line;
  std::getline(lines, line);
  for (std::size_t f = 1; std::getline(lines, line); ++f)
    {
      std::istringstream cells(line);
      std::string        cell;
      for (int c = 0; c <= 5; ++c)
        std::getline(cells, cell, ',');
      EXPECT_NEAR(std::stod(cell) / std::stod(alone[f][5]), 1, 1e-6) << line;
    }
}

TEST_F(Compare, StatesOnTheWay)
{
  run("muscle.xml", "one", keep);
  run("muscle.xml", "half", " --set time/step=0.01" + keep);
  const auto all = compare("one half --all");
  ASSERT_EQ(all.size(), 9u);
  EXPECT_EQ(all[1][0], "0.02");
  EXPECT_EQ(all[5][0], "0.04");
  const auto at = compare("one half --at 0.02");
  ASSERT_EQ(at.size(), 5u);
  EXPECT_EQ(at[1], all[1]);
  EXPECT_EQ(compare("one half")[1], all[5]);
  expect_refused("one half --at 0.03", "both have 0.02, 0.04 s");
  run("muscle.xml", "half", " --set time/step=0.01"); // nothing kept: what was is gone
  EXPECT_EQ(compare("one half --all").size(), 5u);
}

/// A run that goes on keeps what it had; one that goes back does not leave the states of steps to come.
TEST_F(Compare, StatesOfARunThatIsResumed)
{
  run("muscle.xml", "one", keep);
  run("muscle.xml", "one", " --resume --set time/end=0.08" + keep);
  run("muscle.xml", "whole", " --set time/end=0.08" + keep);
  const auto all = compare("one whole --all");
  ASSERT_EQ(all.size(), 17u);
  for (std::size_t r = 1; r < all.size(); r += 4)
    EXPECT_LT(std::stod(all[r][6]), 1e-8);
  std::filesystem::copy_file(folder / "whole/states/state-000000001", folder / "one/checkpoint",
                             std::filesystem::copy_options::overwrite_existing);
  run("muscle.xml", "one", " --resume --set time/end=0.04" + keep);
  EXPECT_TRUE(std::filesystem::exists(folder / "one/states/state-000000002"));
  EXPECT_FALSE(std::filesystem::exists(folder / "one/states/state-000000003"));
}

TEST_F(Compare, WhatCannotBeCompared)
{
  run("muscle.xml", "one");
  run("muscle.xml", "longer", " --set time/end=0.06");
  run("muscle.xml", "thicker", " --set system/geometry/height=0.011");
  run("oscillator.xml", "oscillator");
  expect_refused("one nowhere", "there is no checkpoint");
  expect_refused("one longer", "the runs end at different times, 0.04 s and 0.06 s");
  expect_refused("one longer --all", "no states at equal times");
  expect_refused("one thicker", "the blocks measure 0.03 x 0.01 x 0.01 m and 0.03 x 0.01 x 0.011 m");
  expect_refused("oscillator oscillator", "which has no fields");
  expect_refused("one one --csv nowhere/table.csv", "--csv");
  expect_refused("one", "second is required");
  folder.write("one/checkpoint", "not one");
  expect_refused("one one", "this is not a checkpoint");
}
