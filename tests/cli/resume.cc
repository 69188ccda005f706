// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: --resume goes on bit for bit, extends runs, and refuses what would not be the same run.

#include "program_runner.h"
#include "small_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
  const std::string often = " --quiet --set output/checkpoint/every=2 --set output/checkpoint/seconds=0 ";

  struct Folder : TestFolder
  {
    Folder()
    {
      write("swing.xml", oscillator_scene);
      write("muscle.xml", muscle_scene);
    }

    Outcome run(const std::string &scene, const std::string &out, const std::string &more = "") const
    {
      return run_program(*this, "run " + scene + ".xml --out " + out + often + more);
    }

    std::string text(const std::string &file) const { return contents(*this / file); }
  };

  /// Rows of a table, without its header.
  std::size_t rows(const std::string &table) { return std::count(table.begin(), table.end(), '\n') - 1; }
} // namespace

TEST(Resume, ALaterEndExtendsTheRunBitForBit)
{
  const Folder folder;
  for (const std::string scene : {"swing", "muscle"})
    {
      const std::string end = scene == "swing" ? "0.4" : "0.02", table = scene == "swing" ? "trajectory.csv" : "energy_balance.csv";
      const std::string step = scene == "swing" ? "" : "--set time/step=0.005 ";
      ASSERT_EQ(folder.run(scene, scene + "_whole", step).exit_code, 0);
      ASSERT_EQ(folder.run(scene, scene + "_part", step + "--set time/end=" + end).exit_code, 0);
      const std::string before  = folder.text(scene + "_part/" + table);
      const Outcome     resumed = folder.run(scene, scene + "_part", step + "--resume");
      ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
      for (const std::string &file : {table, std::string("steps.csv")})
        EXPECT_EQ(folder.text(scene + "_part/" + file), folder.text(scene + "_whole/" + file)) << file;
      EXPECT_EQ(folder.text(scene + "_part/" + table).substr(0, before.size()), before);
      EXPECT_NE(folder.text(scene + "_part/manifest.json").find("\"resumed\": \"after step 4 at t = " + end + " s\""), std::string::npos);
    }
}

TEST(Resume, ACutStepGrowsAsIfNothingHadHappened)
{
  // A stiff spring and three Newton iterations: half of the steps are cut, and grow by a factor that is no power of two.
  const Folder      folder;
  const std::string cut = "--set output/checkpoint/every=1 --set \"system/cubic stiffness=1e3\" --set "
                          "\"solver/nonlinear/maximum iterations=3\" --set \"time/control/growth factor=1.5\" ";
  ASSERT_EQ(folder.run("swing", "whole", cut).exit_code, 0);
  ASSERT_EQ(folder.run("swing", "part", cut + "--set time/end=0.5").exit_code, 0);
  const std::string saved = folder.text("part/checkpoint");
  const std::string cuts  = "\"step control: cuts\": [\n   \"";
  ASSERT_NE(saved.find(cuts), std::string::npos);
  EXPECT_NE(saved.substr(saved.find(cuts) + cuts.size(), 2), "0\"") << "the control has something to remember";
  ASSERT_EQ(folder.run("swing", "part", cut + "--resume").exit_code, 0);
  EXPECT_NE(folder.text("part/steps.csv").find("not converged"), std::string::npos);
  for (const char *file : {"trajectory.csv", "steps.csv"})
    EXPECT_EQ(folder.text(std::string("part/") + file), folder.text(std::string("whole/") + file)) << file;
}

TEST(Resume, TheLastRowGivesWayToWhatFollows)
{
  const Folder folder;
  ASSERT_EQ(folder.run("swing", "whole", "--set output/series/every=3").exit_code, 0);
  ASSERT_EQ(folder.run("swing", "part", "--set output/series/every=3 --set time/end=0.4").exit_code, 0);
  EXPECT_NE(folder.text("part/trajectory.csv").find("\n0.4,"), std::string::npos) << "the last state is always written";
  ASSERT_EQ(folder.run("swing", "part", "--set output/series/every=3 --resume").exit_code, 0);
  EXPECT_EQ(folder.text("part/trajectory.csv"), folder.text("whole/trajectory.csv"));
  EXPECT_EQ(rows(folder.text("whole/trajectory.csv")), 5u); // steps 0, 3, 6, 9 and 10
}

TEST(Resume, GoesOnAfterAFailureWithBetterSettings)
{
  // Two quiet steps and then a jump of the boundary that three Newton iterations do not solve.
  Folder      folder;
  std::string scene = muscle_scene;
  scene.replace(scene.find("0 0; 0.02 0.01"), 14, "0 0; 0.02 0.002; 0.0201 0.3");
  folder.write("jump.xml", scene);
  const std::string fixed  = "--set time/step=0.01 --set time/control/type=fixed --set output/checkpoint/every=1 "
                             "--set solver/nonlinear/maximum\\ iterations=";
  const Outcome     failed = folder.run("jump", "part", fixed + "3");
  ASSERT_EQ(failed.exit_code, 3) << failed.err;
  EXPECT_NE(failed.err.find("To resume: "), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("'solver/nonlinear/maximum iterations=3' --resume"), std::string::npos) << failed.err;
  const Outcome again = folder.run("jump", "part", fixed + "3 --resume");
  EXPECT_EQ(again.exit_code, 3) << "the same settings fail again";

  ASSERT_EQ(folder.run("jump", "part", fixed + "40 --resume").exit_code, 0);
  ASSERT_EQ(folder.run("jump", "whole", fixed + "40").exit_code, 0);
  EXPECT_EQ(folder.text("part/reaction.csv"), folder.text("whole/reaction.csv"));
  EXPECT_EQ(folder.text("part/energy_balance.csv"), folder.text("whole/energy_balance.csv"));
  EXPECT_EQ(rows(folder.text("part/steps.csv")), rows(folder.text("whole/steps.csv")) + 2) << "failed attempts stay on the books";
}

TEST(Resume, AFinishedRunIsLeftAlone)
{
  const Folder folder;
  ASSERT_EQ(folder.run("swing", "out").exit_code, 0);
  const auto    written = std::filesystem::last_write_time(folder / "out/manifest.json");
  const Outcome outcome = run_program(folder, "run swing.xml --out out --resume --set output/checkpoint/every=2");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("is finished: 10 steps to t = 1 s"), std::string::npos) << outcome.out;
  EXPECT_EQ(std::filesystem::last_write_time(folder / "out/manifest.json"), written);
}

TEST(Resume, WithoutACheckpointSaysWhatItLookedFor)
{
  const Folder  folder;
  const Outcome outcome = folder.run("swing", "out", "--resume");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("out/checkpoint: there is no checkpoint"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(Resume, AManifestThatTheEndOfAMachineHasEmptiedIsWrittenAnew)
{
  const Folder folder;
  ASSERT_EQ(folder.run("swing", "whole").exit_code, 0);
  ASSERT_EQ(folder.run("swing", "part", "--set time/end=0.4").exit_code, 0);
  const std::string manifest = folder.text("part/manifest.json");
  for (const std::string &left : {std::string(), manifest.substr(0, manifest.size() / 2), std::string("{}"), std::string(300, '\0')})
    {
      std::filesystem::copy(folder / "part", folder / "again", std::filesystem::copy_options::recursive);
      folder.write("again/manifest.json", left);
      const Outcome anew = folder.run("swing", "again", "--overwrite");
      EXPECT_EQ(anew.exit_code, 2) << "whose the files are is not known";
      EXPECT_EQ(folder.text("again/manifest.json"), left);
      EXPECT_FALSE(std::filesystem::exists(folder / "again/run.lock"));
      const Outcome resumed = folder.run("swing", "again", "--resume");
      ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
      EXPECT_EQ(folder.text("again/trajectory.csv"), folder.text("whole/trajectory.csv"));
      for (const char *listed : {"trajectory.csv", "checkpoint", "\"done\""})
        EXPECT_NE(folder.text("again/manifest.json").find(listed), std::string::npos) << listed;
      ASSERT_EQ(folder.run("swing", "again", "--overwrite").exit_code, 0) << "the folder is known again";
      std::filesystem::remove_all(folder / "again");
    }
}

TEST(Resume, RefusesAnotherRunNamingWhatDiffers)
{
  const Folder folder;
  ASSERT_EQ(folder.run("swing", "out", "--set time/end=0.5").exit_code, 0);
  const std::string before = folder.text("out/trajectory.csv");
  const Outcome     other  = folder.run("swing", "out", "--resume --set system/mass=3 --set \"time/boundary rates=scheme\"");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("swing.xml: system/mass: is \"3\", in the run to resume it was \"2\""), std::string::npos) << other.err;
  EXPECT_NE(other.err.find("time/boundary rates"), std::string::npos) << other.err;
  EXPECT_EQ(other.err.find("time/end:"), std::string::npos) << other.err;
  EXPECT_EQ(folder.text("out/trajectory.csv"), before);

  const Outcome early = folder.run("swing", "out", "--resume --set time/end=0.2");
  EXPECT_EQ(early.exit_code, 2);
  EXPECT_NE(early.err.find("has passed the end: it is at t = 0.5 s"), std::string::npos) << early.err;
}

TEST(Resume, ANewRunLeavesNothingOfTheOldOneToResume)
{
  const Folder folder;
  ASSERT_EQ(folder.run("swing", "out").exit_code, 0);
  ASSERT_TRUE(std::filesystem::exists(folder / "out/checkpoint"));
  const std::string hopeless = "--set time/control/type=fixed --set solver/nonlinear/maximum\\ iterations=";
  ASSERT_EQ(folder.run("swing", "out", hopeless + "1 --overwrite").exit_code, 3);
  // Not a step was accepted: the start is what can be resumed.
  const Outcome resumed = folder.run("swing", "out", hopeless + "50 --resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  ASSERT_EQ(folder.run("swing", "whole", hopeless + "50").exit_code, 0);
  EXPECT_EQ(folder.text("out/trajectory.csv"), folder.text("whole/trajectory.csv"));
}

TEST(Resume, AFileThatHasChangedIsTold)
{
  Folder      folder;
  std::string scene = oscillator_scene;
  const auto  begin = scene.find("<Parameter name=\"points\"");
  scene.replace(begin, scene.find("/>", begin) - begin, "<Parameter name=\"file\" type=\"string\" value=\"push.dat\"");
  folder.write("pushed.xml", scene);
  folder.write("push.dat", "0 0\n0.3 1\n0.5 1\n");
  ASSERT_EQ(folder.run("pushed", "out", "--set time/end=0.5").exit_code, 0);
  EXPECT_NE(folder.text("out/manifest.json").find("push.dat\": \""), std::string::npos) << folder.text("out/manifest.json");
  const Outcome same = folder.run("pushed", "out", "--set time/end=0.7 --resume");
  EXPECT_EQ(same.out, "");
  folder.write("push.dat", "0 0\n0.3 1\n0.5 2\n");
  const Outcome other = folder.run("pushed", "out", "--resume");
  EXPECT_EQ(other.exit_code, 0);
  EXPECT_NE(other.out.find("push.dat has changed since"), std::string::npos) << other.out;
  EXPECT_NE(folder.text("out/manifest.json").find("push.dat has changed since"), std::string::npos);
}

TEST(Resume, TablesThatAreNotThoseOfTheRunAreRefusedBeforeAnythingIsCut)
{
  const Folder folder;
  ASSERT_EQ(folder.run("swing", "out", "--set time/end=0.5").exit_code, 0);
  const std::string steps = folder.text("out/steps.csv"), table = folder.text("out/trajectory.csv");
  std::string       other = table;
  other[other.rfind('1')] = '7';
  folder.write("out/trajectory.csv", other);
  folder.write("out/steps.csv", steps + "99,later rows\n");
  const Outcome refused = folder.run("swing", "out", "--resume");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("trajectory.csv: its rows are not those that were written"), std::string::npos) << refused.err;
  EXPECT_EQ(folder.text("out/steps.csv"), steps + "99,later rows\n");
  folder.write("out/trajectory.csv", table);
  EXPECT_EQ(folder.run("swing", "out", "--resume").exit_code, 0);
  EXPECT_EQ(folder.text("out/steps.csv").find("later"), std::string::npos);
}

TEST(Memory, IsToldAndRefusedBeforeAnythingLargeIsMade)
{
  const Folder  folder;
  const Outcome fits = run_program(folder, "check muscle.xml");
  EXPECT_EQ(fits.exit_code, 0);
  EXPECT_NE(fits.out.find("memory of a rank: about 0.201 GB (program 0.2 GB"), std::string::npos) << fits.out;
  const Outcome large = run_program(folder, "check muscle.xml --set system/geometry/refinement=8 --set system/discretisation/degree=3");
  EXPECT_EQ(large.exit_code, 2);
  EXPECT_NE(large.err.find("physical memory of the node"), std::string::npos) << large.err;
  EXPECT_NE(large.err.find("a smaller system/geometry/refinement"), std::string::npos) << large.err;
}
