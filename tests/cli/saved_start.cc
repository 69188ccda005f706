// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: a run that starts from a state that another one has saved goes on as that one, and states of other bodies are refused.

#include "program_runner.h"
#include "small_scenes.h"

#include <myolines/scene/csv.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  const std::string from_saved = " --set \"time/start state=saved\" --set \"time/saved state=";

  /// The last row of a table, or that of another number.
  std::vector<std::string> row_of_table(const TestFolder &folder, const std::string &file, const bool last)
  {
    const auto table = myolines::scene::read_csv(folder / file);
    return last ? table.value().rows.back() : table.value().rows.front();
  }
} // namespace

/// u = cos(t), in two halves of a method without memory: bit-equal to the whole.
TEST(SavedStart, HalvesAreTheWhole)
{
  const TestFolder folder;
  folder.write("scene.xml", free_oscillation);
  const std::string run = "run scene.xml --quiet --set integrator/type=sdirk3 --set time/step=0.125 ";
  ASSERT_EQ(run_program(folder, run + "--out whole").exit_code, 0);
  ASSERT_EQ(run_program(folder, run + "--out first --set time/end=1").exit_code, 0);
  const Outcome second = run_program(folder, run + "--out second --set time/start=1" + from_saved + "first/checkpoint\"");
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(row_of_table(folder, "second/trajectory.csv", true), row_of_table(folder, "whole/trajectory.csv", true));
}

/// Held, stretched, let go: the body starts where it was held, at a time of its own, with velocities, and comes back.
TEST(SavedStart, ABodyIsLetGo)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  ASSERT_EQ(run_program(folder, "run scene.xml --quiet --out held --set output/checkpoint/keep/every=1").exit_code, 0);
  const std::string let_go = "run scene.xml --quiet --unset \"system/boundary/moving end\" --set time/end=0.2 --set time/step=0.02"
                             " --out free" +
                             from_saved + "held/states/state-000000002\"";
  const Outcome outcome = run_program(folder, let_go);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  auto held = row_of_table(folder, "held/displacements-3d.csv", true), begin = row_of_table(folder, "free/displacements-3d.csv", false);
  EXPECT_EQ(begin.front(), "0");
  held.erase(held.begin());
  begin.erase(begin.begin());
  EXPECT_EQ(begin, held);
  EXPECT_LT(std::abs(std::stod(row_of_table(folder, "free/displacements-3d.csv", true).at(1))), 0.01 * std::stod(held.front()));
}

TEST(SavedStart, RefusesOtherBodiesAndWhatIsNotLookedAt)
{
  const TestFolder folder;
  folder.write("scene.xml", muscle_scene);
  folder.write("oscillation.xml", free_oscillation);
  ASSERT_EQ(run_program(folder, "run scene.xml --quiet --out held").exit_code, 0);
  const auto refusal = [&](const std::string &arguments) {
    const Outcome refused = run_program(folder, "check " + arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments << refused.out;
    return refused.err;
  };
  const std::string state = from_saved + "held/checkpoint\"";
  EXPECT_NE(refusal("scene.xml --set system/geometry/refinement=1" + state).find("another \"system/geometry/refinement\""),
            std::string::npos);
  EXPECT_NE(refusal("oscillation.xml" + state).find("another \"system/"), std::string::npos);
  const std::string rod = myolines::test::source_folder() + "/input/rod_linear.xml --set \"time/start velocity=consistent\" ";
  ASSERT_EQ(run_program(folder, "run " + rod + "--quiet --out rod --set time/end=0.001 --set time/step=0.0005").exit_code, 0);
  const std::string stretched_rod = from_saved + "rod/checkpoint\"";
  EXPECT_EQ(run_program(folder, "check " + rod + stretched_rod).exit_code, 0);
  EXPECT_NE(refusal(rod + "--set system/length=0.05" + stretched_rod).find("another \"system/length\""), std::string::npos);
  EXPECT_NE(refusal("scene.xml --set \"time/start state=saved\"").find("no \"saved state\""), std::string::npos);
  EXPECT_NE(refusal("scene.xml --set \"time/saved state=held/checkpoint\"").find("not looked at"), std::string::npos);
  EXPECT_NE(refusal("scene.xml --set \"time/start velocity=impulse\"" + state).find("has its velocities"), std::string::npos);
  EXPECT_NE(refusal("scene.xml" + from_saved + "scene.xml\"").find("not a checkpoint"), std::string::npos);
}
