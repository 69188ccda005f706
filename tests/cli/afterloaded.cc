// SPDX-License-Identifier: LGPL-2.1-or-later
// The scene of an afterloaded contraction: its columns, its three phases, and what `check` says of it.
#include "../support/places.h"
#include "program_runner.h"

#include <gtest/gtest.h>

namespace
{
  const std::string scene =
      myolines::test::source_folder() + "/input/afterloaded_contraction.xml --set system/geometry/refinement=0 --set time/step=0.01";

  std::vector<std::string> split(const std::string &line)
  {
    std::vector<std::string> cells;
    std::istringstream       text(line);
    for (std::string cell; std::getline(text, cell, ',');)
      cells.push_back(cell);
    return cells;
  }
} // namespace

TEST(AfterloadedContraction, IsIsometricThenIsotonicThenIsometric)
{
  const TestFolder folder;
  const Outcome    outcome = run_program(folder, "run " + scene + " --quiet --out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(contents(folder / "out" / "reaction.csv"));
  std::string        line;
  std::getline(lines, line);
  const std::vector<std::string> header = split(line);
  ASSERT_EQ(header.size(), 10u);
  ASSERT_EQ(header[4], "load x [N]");
  ASSERT_EQ(header[7], "load stop [N]");
  std::string phases; // s on the stop, f free of it, without repetition
  while (std::getline(lines, line))
    {
      const auto   cells = split(line);
      const double pull = std::stod(cells[4]), stop = std::stod(cells[7]);
      EXPECT_NEAR(pull, 8 + stop, 1e-4) << line;
      EXPECT_LE(stop, 0) << line;
      const char phase = stop < 0 ? 's' : 'f';
      if (phases.empty() || phases.back() != phase)
        phases += phase;
    }
  EXPECT_EQ(phases, "sfs");
  EXPECT_EQ(contents(folder / "out" / "energy_balance.csv").find("Stored springs [J]") != std::string::npos, true);
}

TEST(AfterloadedContraction, ALoadThatPullsAwayFromItsStopIsRefused)
{
  const TestFolder folder;
  const Outcome    outcome = run_program(folder, "check " + scene + " --set system/boundary/load/force=-8");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("boundary/load/force: pulls the face away from its stop"), std::string::npos) << outcome.err;
}

TEST(AfterloadedContraction, CheckTellsOfItsTieAndItsStop)
{
  const TestFolder  folder;
  const std::string told = run_program(folder, "check " + scene).out;
  EXPECT_NE(told.find("on   ties: load (x+) moves as one, held across; 8 relations between unknowns"), std::string::npos) << told;
  EXPECT_NE(told.find("on   springs at faces: load (x+) has a stop at 0 m"), std::string::npos) << told;
  const std::string plain = run_program(folder, "check " + myolines::test::source_folder() + "/input/isometric_block.xml").out;
  EXPECT_NE(plain.find("off  ties: no face"), std::string::npos) << plain;
  EXPECT_NE(plain.find("off  springs at faces: no foundation, tendon or stop"), std::string::npos) << plain;
}
