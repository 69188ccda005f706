// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: a rod resumed from a checkpoint writes the tables of a run that was not interrupted, byte for byte, with every method.

#include "../support/places.h"
#include "program_runner.h"

#include <myolines/time/integrator.h>

#include <gtest/gtest.h>

using namespace myolines;

namespace
{
  /// The rod of input/, on a ramp that begins at 0.01 s. Rows are written beside the steps that are kept, and some of the instants
  /// asked for lie within steps.
  struct RodFolder : TestFolder
  {
    RodFolder()
    {
      std::string scene = contents(myolines::test::source_folder() + "/input/rod_neo_hookean.xml");
      for (const std::string parameter : {"alpha", "first step"}) // of its method, which are no parameters of others
        {
          const std::size_t begin = scene.find("<Parameter name=\"" + parameter + "\"");
          if (begin == std::string::npos)
            throw std::logic_error("the scene of the rod has changed");
          scene.erase(begin, scene.find('\n', begin) - begin);
        }
      write("rod.xml", scene);
    }

    Outcome run(const std::string &out, const std::string &method, const std::string &end, const std::string &more = "") const
    {
      return run_program(*this, "run rod.xml --quiet --out " + out + " --set \"integrator/type=" + method + "\" --set time/end=" + end +
                                    " --set system/profile/start=0.01 --set time/step=1e-4 --set \"time/boundary rates=exact\""
                                    " --set output/series/every=3 --set \"output/nodal states/times=0.0119 0.01195 0.01234 0.016\""
                                    " --set output/checkpoint/every=20 --set output/checkpoint/seconds=0 " +
                                    more);
    }

    std::string text(const std::string &file) const { return contents(*this / file); }

    void expect_same_tables(const std::string &a, const std::string &b) const
    {
      for (const std::string table : {"trace.csv", "reaction.csv", "nodal_states.csv", "steps.csv"})
        {
          EXPECT_EQ(text(a + "/" + table), text(b + "/" + table)) << table;
          EXPECT_GT(text(b + "/" + table).size(), 1000u) << table;
        }
    }
  };
} // namespace

TEST(ResumeRod, EveryMethodGoesOnBitForBit)
{
  for (const IntegratorEntry &entry : integrator_registry())
    {
      if (!entry.facts.dynamic || entry.facts.restart != MethodFacts::Restart::exact || entry.facts.two_states)
        continue; // or needs forces that this rod does not have
      SCOPED_TRACE(entry.facts.name);
      const RodFolder folder;
      const Outcome   whole = folder.run("whole", entry.facts.name, "0.016");
      ASSERT_EQ(whole.exit_code, 0) << whole.err;
      ASSERT_EQ(folder.run("part", entry.facts.name, "0.012").exit_code, 0);
      const Outcome resumed = folder.run("part", entry.facts.name, "0.016", "--resume");
      ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
      EXPECT_NE(folder.text("part/manifest.json").find(" at t = 0.012 s\""), std::string::npos);
      folder.expect_same_tables("whole", "part");
    }
}

TEST(ResumeRod, ALinearRodGoesOnBitForBit)
{
  // step sizes differ in their last bits; factors made for one of them serve the others, but must not outlive a checkpoint
  const TestFolder folder;
  const auto       run = [&](const std::string &out, const std::string &end, const std::string &more = "") {
    const Outcome outcome = run_program(folder, "run " + myolines::test::source_folder() + "/input/rod_linear.xml --quiet --out " + out +
                                                          " --set time/end=" + end + " --set output/checkpoint/every=20 " + more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  };
  run("whole", "0.5");
  run("part", "0.24");
  run("part", "0.5", "--resume");
  for (const std::string table : {"trace.csv", "reaction.csv", "steps.csv"})
    EXPECT_EQ(contents(folder / ("whole/" + table)), contents(folder / ("part/" + table))) << table;
}

TEST(ResumeRod, RowsAfterTheCheckpointAreWrittenAnew)
{
  // what a kill leaves: tables that are ahead of the last checkpoint
  const RodFolder   folder;
  const std::string method = "hht alpha"; // keeps the force at the end of the last step
  ASSERT_EQ(folder.run("whole", method, "0.016").exit_code, 0);
  ASSERT_EQ(folder.run("part", method, "0.012").exit_code, 0);
  std::filesystem::copy_file(folder / "part/checkpoint", folder / "checkpoint");
  ASSERT_EQ(folder.run("part", method, "0.014", "--resume").exit_code, 0);
  std::filesystem::copy_file(folder / "checkpoint", folder / "part/checkpoint", std::filesystem::copy_options::overwrite_existing);
  ASSERT_EQ(folder.run("part", method, "0.016", "--resume").exit_code, 0);
  folder.expect_same_tables("whole", "part");
}
