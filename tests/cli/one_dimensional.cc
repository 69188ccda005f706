// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/places.h"
#include "program_runner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace
{
  const std::string unit  = myolines::test::source_folder() + "/input/one_dimensional/muscle_tendon_unit.xml";
  const std::string chain = myolines::test::source_folder() + "/input/one_dimensional/isometric_chain.xml";

  std::vector<std::string> lines(const std::filesystem::path &file)
  {
    std::istringstream       text(contents(file));
    std::vector<std::string> all;
    for (std::string line; std::getline(text, line);)
      all.push_back(line);
    return all;
  }
} // namespace

TEST(OneDimensional, unitsWriteTheirSeries)
{
  const TestFolder folder;
  for (const std::string masses : {"0", "2"})
    {
      const Outcome outcome = run_program(folder, "run " + unit + " --quiet --out u --set time/end=0.1 --set system/masses=" + masses);
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      const auto rows = lines(folder / "u/muscle_tendon.csv");
      ASSERT_EQ(rows.size(), 7u);
      EXPECT_EQ(rows[0], "Time [s],excitation,activation,muscle stretch,muscle strain rate,tendon strain,tendon force/F0");
      EXPECT_EQ(rows[1].substr(0, 2), "0,");
    }
}

TEST(OneDimensional, unitsThatNoLengthBalancesAreRefused)
{
  const TestFolder folder;
  const Outcome    refused = run_program(folder, "check " + myolines::test::source_folder() +
                                                     "/input/one_dimensional/muscle_tendon_unit.xml --set system/input/base=2");
  EXPECT_EQ(refused.exit_code, 2);
  for (const char *part : {"muscle_tendon_unit.xml: system/input: ", "balance at no length of the muscle", "expected: ", "hint: "})
    EXPECT_NE(refused.err.find(part), std::string::npos) << part << " in " << refused.err;
}

TEST(OneDimensional, chainsWriteStretchesAndEquilibria)
{
  const TestFolder folder;
  folder.write("chain.xml", contents(chain).replace(contents(chain).find("<ParameterList name=\"stretches\">"), 0,
                                                    "<ParameterList name=\"equilibria\"/>"));
  const Outcome outcome = run_program(folder, "run chain.xml --quiet --out c --set time/end=0.5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(lines(folder / "c/stretches.csv").size(), 4u);
  EXPECT_EQ(lines(folder / "c/stretches.csv")[0].substr(0, 30), "Time [s],stretch 1,stretch 2,s");
  const auto rows = lines(folder / "c/equilibria.csv");
  EXPECT_GT(rows.size(), 9u);
  unsigned int without_middle = 0;
  for (const std::string &row : rows)
    without_middle += row.find(",0,") == row.find(',') ? 1 : 0;
  EXPECT_EQ(without_middle, 8u);
}

TEST(OneDimensional, modesTellWhatGrows)
{
  const TestFolder folder;
  const Outcome    falling = run_program(folder, "modes " + chain + " --set system/perturbation=0 --out m.csv");
  ASSERT_EQ(falling.exit_code, 0) << falling.err;
  EXPECT_NE(falling.out.find("32, of which 16 grow"), std::string::npos) << falling.out;
  const auto rows = lines(folder / "m.csv");
  ASSERT_EQ(rows.size(), 33u);
  EXPECT_NEAR(std::stod(rows[1]), 1.069, 1e-3);
  const Outcome rising = run_program(folder, "modes " + chain + " --set system/perturbation=0 --set system/stretch=0.85");
  EXPECT_NE(rising.out.find("of which 0 grow"), std::string::npos) << rising.out;
  EXPECT_EQ(run_program(folder, "modes " + unit + " --set system/activation=unknown").exit_code, 2);
}

TEST(OneDimensional, modesAlongARunTellWhereStabilityIsLost)
{
  const TestFolder folder;
  const Outcome    run = run_program(folder, "run " + chain + " --quiet --out c --set time/end=0.01 --set output/checkpoint/keep/every=1");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Outcome along = run_program(folder, "modes " + chain + " --along c --number 2");
  ASSERT_EQ(along.exit_code, 0) << along.err;
  const auto rows = lines(folder / "c/modes.csv");
  ASSERT_GT(rows.size(), 3u);
  EXPECT_EQ(rows[0], "Time [s],eigenvalue 1 [1/s^2],eigenvalue 2 [1/s^2]");
  const double smallest = std::stod(rows.back().substr(rows.back().find(',') + 1));
  EXPECT_NEAR(smallest, -1911. * 1911, 0.05 * 1911 * 1911); // the largest growth rate without force-velocity
  EXPECT_EQ(run_program(folder, "modes " + chain + " --along c --at 0.01 --out one.csv").exit_code, 0);
  EXPECT_EQ(lines(folder / "one.csv").size(), 2u);
  EXPECT_EQ(run_program(folder, "modes " + chain + " --along c --at 7").exit_code, 2);
  EXPECT_EQ(run_program(folder, "modes " + chain + " --along c --set system/stretch=0.9").exit_code, 2);
  EXPECT_EQ(run_program(folder, "modes " + chain + " --along nowhere").exit_code, 2);
}
