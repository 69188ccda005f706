// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: what the system refuses ends a run with exit code 4, its first reason and everything before it whole; nothing of others is
// touched; names are never commands.

#include "program_runner.h"
#include "small_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sys/stat.h>

namespace
{
  struct Faulty : TestFolder
  {
    Faulty()
    {
      write("swing.xml", oscillator_scene);
      write("muscle.xml", muscle_scene);
    }
    std::string text(const std::string &file) const { return contents(*this / file); }
    bool        is_there(const std::string &file) const { return std::filesystem::exists(*this / file); }
  };

  bool has(const std::string &text, const std::string &word) { return text.find(word) != std::string::npos; }

  const std::string long_run =
      "run swing.xml --set time/step=5e-5 --set output/checkpoint/every=200 --set output/checkpoint/seconds=0 --out ";

  /// Starts a run that writes to @p out, and forbids its files to become longer than @p bytes once it is under way: what a full disk is to
  /// a program. MPI itself needs longer files at its start.
  Outcome run_on_a_full_disk(const TestFolder &folder, const std::string &arguments, const std::string &out, const int bytes)
  {
    const std::string wait =
        "while kill -0 $p 2> nothing.txt && [ $(cat " + out +
        "/steps.csv 2> nothing.txt | wc -l) -lt 3 ]; do sleep 0.01; done; prlimit --pid $p --fsize=" + std::to_string(bytes) + "; wait $p";
    const std::string command = "cd '" + folder.path().string() + "' && { '" + myolines::test::program_file() + "' " + arguments + out +
                                " > out.txt 2> err.txt < /dev/null & p=$!; " + wait + "; }";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / "out.txt"), contents(folder / "err.txt")};
  }
} // namespace

TEST(SystemRefuses, ATableThatTheDiskDoesNotTake)
{
  const Faulty  folder;
  const Outcome refused = run_on_a_full_disk(folder, long_run, "part", 100000);
  EXPECT_EQ(refused.exit_code, 4) << refused.err;
  EXPECT_TRUE(has(refused.err, "The system refused: cannot write")) << refused.err;
  EXPECT_TRUE(has(refused.err, ": File too large, after step ")) << refused.err;
  EXPECT_TRUE(has(refused.err, "To resume: ")) << refused.err;
  EXPECT_TRUE(has(folder.text("part/manifest.json"), "the system refused: cannot write")) << folder.text("part/manifest.json");
  for (const char *table : {"trajectory.csv", "steps.csv", "run.log"})
    EXPECT_EQ(folder.text(std::string("part/") + table).back(), '\n') << table << " ends with a whole row";

  const Outcome resumed = run_program(folder, long_run + "part --resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  ASSERT_EQ(run_program(folder, long_run + "whole").exit_code, 0);
  EXPECT_EQ(folder.text("part/trajectory.csv"), folder.text("whole/trajectory.csv"));
}

TEST(SystemRefuses, HdfFilesAndFields)
{
  for (const char *output : {"output/quadrature/every=40", "output/quadrature/format=flexodeal --set output/quadrature/every=40",
                             "output/fields/format=hdf5 --set output/fields/every=40"})
    {
      const Faulty      folder;
      const std::string run =
          std::string("run muscle.xml --set system/geometry/refinement=1 --set time/step=0.0002 --set ") + output + " --out ";
      const Outcome refused = run_on_a_full_disk(folder, run, "out", 16000);
      EXPECT_EQ(refused.exit_code, 4) << output << "\n" << refused.err;
      EXPECT_TRUE(has(refused.err, "File too large, after step ")) << refused.err;
      EXPECT_FALSE(has(refused.err, "HDF5-DIAG")) << refused.err;
      EXPECT_TRUE(has(folder.text("out/manifest.json"), "the system refused: cannot write")) << folder.text("out/manifest.json");
      EXPECT_EQ(run_program(folder, run + "out --resume").exit_code, 0);
    }
}

TEST(SystemRefuses, ARunWhoseFolderGoes)
{
  const Faulty      folder;
  const std::string command = "cd '" + folder.path().string() + "' && { '" + myolines::test::program_file() + "' " + long_run +
                              "gone > out.txt 2> err.txt < /dev/null & p=$!; "
                              "while [ $(cat gone/steps.csv 2> nothing.txt | wc -l) -lt 3 ]; do sleep 0.01; done; mv gone went; wait $p; }";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4) << folder.text("err.txt");
  EXPECT_TRUE(has(folder.text("err.txt"), "The system refused: cannot ")) << folder.text("err.txt");
  EXPECT_TRUE(has(folder.text("err.txt"), "No such file or directory, after step ")) << folder.text("err.txt");
  EXPECT_FALSE(folder.is_there("gone"));
}

TEST(SystemRefuses, MoreMemoryThanTheBatchJobHas)
{
  const Faulty  folder;
  const Outcome refused = run_program(folder, "check muscle.xml", "SLURM_MEM_PER_NODE=100");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(has(refused.err, "SLURM_MEM_PER_NODE")) << refused.err;
  EXPECT_EQ(run_program(folder, "check muscle.xml", "SLURM_MEM_PER_CPU=1000 SLURM_CPUS_ON_NODE=4").exit_code, 0);
}

TEST(SystemRefuses, StandardOutputThatIsFull)
{
  const Faulty      folder;
  const std::string command =
      "cd '" + folder.path().string() + "' && '" + myolines::test::program_file() + "' run swing.xml --out out > /dev/full 2> err.txt";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_TRUE(has(folder.text("err.txt"), "cannot write standard output"));
  EXPECT_TRUE(has(folder.text("out/manifest.json"), "\"done\"")) << "the run itself is whole";
  const std::string help = "'" + myolines::test::program_file() + "' --help > /dev/full 2> '" + (folder / "err.txt").string() + "'";
  EXPECT_EQ(WEXITSTATUS(std::system(help.c_str())), 4);
}

TEST(SystemRefuses, ARunGoesOnWithoutItsReader)
{
  const Faulty      folder;
  const std::string command =
      "cd '" + folder.path().string() + "' && { '" + myolines::test::program_file() + "' run swing.xml --out out 2> err.txt; } | true";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(has(folder.text("out/manifest.json"), "\"done\""));
}

TEST(SystemRefuses, AHangUpIsASignalToStopUnlessItIsIgnored)
{
  const Faulty      folder;
  const std::string run =
      " '" + myolines::test::program_file() + "' run swing.xml --quiet --set time/step=2e-5 --set output/checkpoint/seconds=600 --out ";
  const auto hang_up = [&](const std::string &how, const std::string &out, const std::string &file = "steps.csv") {
    return std::system(("cd '" + folder.path().string() + "'; " + how + run + out + " > o.txt 2> e.txt & p=$!; while [ ! -s '" +
                        (folder / out / file).string() + "' ]; do sleep 0.02; done; kill -HUP $p; wait $p")
                           .c_str());
  };
  EXPECT_EQ(WEXITSTATUS(hang_up("", "stopped")), 3);
  EXPECT_TRUE(has(folder.text("stopped/manifest.json"), "asked to stop by the signal"));
  EXPECT_EQ(WEXITSTATUS(hang_up("", "early", "run.lock")), 3) << "before the first step";
  EXPECT_TRUE(has(folder.text("early/manifest.json"), "asked to stop by the signal"));
  EXPECT_TRUE(folder.is_there("early/checkpoint"));
  EXPECT_EQ(WEXITSTATUS(hang_up("nohup", "ignored")), 0);
}

TEST(RunFolders, ResultsOfAnotherSceneNeedToBeOverwritten)
{
  const Faulty      folder;
  const std::string run = "run swing.xml --out out --quiet ";
  ASSERT_EQ(run_program(folder, run).exit_code, 0);
  ASSERT_EQ(run_program(folder, run).exit_code, 0) << "the same again";
  const std::string before = folder.text("out/trajectory.csv");
  folder.write("other.xml", folder.text("swing.xml"));
  const Outcome refused = run_program(folder, "run other.xml --out out --quiet --set system/mass=3");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(has(refused.err, "--overwrite")) << refused.err;
  EXPECT_EQ(folder.text("out/trajectory.csv"), before);
  ASSERT_EQ(run_program(folder, "run other.xml --out out --quiet --set system/mass=3 --overwrite").exit_code, 0);
  EXPECT_NE(folder.text("out/trajectory.csv"), before);
}

TEST(RunFolders, ARunThatIsRefusedLeavesNothing)
{
  const Faulty  folder;
  const Outcome outside = run_program(folder, "run muscle.xml --out out --set \"output/series/markers=far 1 1 1\"");
  EXPECT_EQ(outside.exit_code, 2) << "what an output refuses";
  EXPECT_FALSE(folder.is_there("out")) << outside.err;
  ASSERT_EQ(run_program(folder, "run swing.xml --out out --quiet").exit_code, 0);
  EXPECT_FALSE(folder.is_there("out/run.lock")) << "nor does a run that is done";
  EXPECT_EQ(run_program(folder, "run muscle.xml --out out").exit_code, 2) << "another scene";
  EXPECT_FALSE(folder.is_there("out/run.lock"));
}

TEST(RunFolders, ResultsOfTheSameSceneWithOtherValuesAreKeptAside)
{
  const Faulty      folder;
  const std::string run = "run swing.xml --out out --quiet ";
  ASSERT_EQ(run_program(folder, run).exit_code, 0);
  const std::string before = folder.text("out/trajectory.csv");
  ASSERT_EQ(run_program(folder, run + "--set system/mass=3").exit_code, 0);
  EXPECT_EQ(folder.text("out/earlier-1/trajectory.csv"), before);
  EXPECT_NE(folder.text("out/trajectory.csv"), before);
  ASSERT_EQ(run_program(folder, run + "--set system/mass=4").exit_code, 0);
  EXPECT_TRUE(folder.is_there("out/earlier-2/manifest.json"));
  ASSERT_EQ(run_program(folder, run + "--set system/mass=5 --overwrite").exit_code, 0);
  EXPECT_FALSE(folder.is_there("out/earlier-3"));
}

TEST(RunFolders, FilesOfOthersAreLeftAlone)
{
  const Faulty folder;
  std::filesystem::create_directories(folder / "out");
  folder.write("out/trajectory.csv", "mine");
  const Outcome refused = run_program(folder, "run swing.xml --out out --overwrite");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(has(refused.err, "trajectory.csv")) << refused.err;
  EXPECT_EQ(folder.text("out/trajectory.csv"), "mine");
}

TEST(RunFolders, PlotDrawsWhatTheRunWroteAndNothingElse)
{
  const Faulty folder;
  ASSERT_EQ(run_program(folder, "run swing.xml --out out --quiet --set output/motion/interval=0.1").exit_code, 0);
  ASSERT_EQ(run_program(folder, "plot out").exit_code, 0);
  EXPECT_TRUE(folder.is_there("out/pictures/motion_m.png") || folder.is_there("out/pictures/motion.png")) << "columns of the table";
  ASSERT_EQ(run_program(folder, "run swing.xml --out out --quiet --overwrite").exit_code, 0);
  EXPECT_FALSE(folder.is_there("out/motion.csv"));
  EXPECT_FALSE(folder.is_there("out/pictures"));
  folder.write("out/other.csv", "Time [s],x [m]\n0,1\n1,2\n");
  ASSERT_EQ(run_program(folder, "plot out").exit_code, 0);
  EXPECT_TRUE(folder.is_there("out/pictures"));
  EXPECT_FALSE(folder.is_there("out/pictures/other_m.png"));
}

TEST(RunFolders, NamesAreNeverCommands)
{
  const Faulty folder;
  for (const std::string name : {"Anna's run", "'; system(\"touch executed\"); #", "`touch executed`", "$(touch executed)", "{a,b}", "a\nb",
                                 "[x] ~y \"z\" \\n", "-x"})
    {
      // Through a variable: the shell of this test has nothing to read into the name.
      setenv("NAME", name.c_str(), 1);
      const Outcome run = run_program(folder, "run swing.xml --set time/step=0.1 --out \"./$NAME\"");
      ASSERT_EQ(run.exit_code, 0) << name << run.err;
      const std::size_t hint = run.out.find("plot ");
      ASSERT_NE(hint, std::string::npos) << run.out;
      // The line that was printed does what it says.
      const std::size_t begin = run.out.rfind('\n', hint) + 1;
      std::size_t       end   = run.out.find("\n  ", hint);
      const std::string line  = run.out.substr(begin, end - begin);
      EXPECT_EQ(std::system(("cd '" + folder.path().string() + "' && { " + line + "\n} > plot.txt 2>&1").c_str()), 0)
          << line << folder.text("plot.txt");
      EXPECT_TRUE(std::filesystem::exists(folder.path() / name / "pictures")) << name;
      EXPECT_FALSE(folder.is_there("executed")) << name;
    }
}

TEST(Inputs, WhatIsNoTextIsTold)
{
  const Faulty folder;
  std::string  latin = oscillator_scene, cut = oscillator_scene, utf16 = "\xFF\xFE";
  latin.insert(latin.find("  <Par"), "<!-- M\xFCller -->");
  cut[cut.find("mass")] = '\0';
  for (const char c : oscillator_scene)
    utf16 += std::string({c, '\0'});
  folder.write("latin.xml", latin);
  folder.write("zero.xml", cut);
  folder.write("utf16.xml", utf16);
  folder.write("bom.xml", "\xEF\xBB\xBF" + oscillator_scene);
  ASSERT_EQ(mkfifo((folder / "pipe.xml").c_str(), 0600), 0);
  for (const auto &[file, told] : {std::pair<const char *, const char *>{"latin.xml", "0xFC in line 3 is not UTF-8"},
                                   {"zero.xml", "zero byte in line"},
                                   {"utf16.xml", "UTF-16"},
                                   {"pipe.xml", "it is a pipe"},
                                   {"/dev/zero", "it is a device"},
                                   {"''", "it has no name"}})
    {
      const Outcome outcome = run_program(folder, std::string("check ") + file, "timeout 20");
      EXPECT_EQ(outcome.exit_code, 2) << file << outcome.err;
      EXPECT_TRUE(has(outcome.err, told)) << outcome.err;
    }
  EXPECT_EQ(run_program(folder, "check bom.xml").exit_code, 0);
}

TEST(Inputs, IntervalsBelowTheRoundingOfTimesAreRefused)
{
  const Faulty  folder;
  const Outcome refused = run_program(folder, "check swing.xml --set output/motion/interval=1e-300");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(has(refused.err, "below the rounding of the times")) << refused.err;
  const Outcome many = run_program(folder, "check swing.xml --set output/motion/interval=1e-7");
  EXPECT_EQ(many.exit_code, 0);
  EXPECT_TRUE(has(many.out, "output/motion will have 1e+07 rows")) << many.out;
}
