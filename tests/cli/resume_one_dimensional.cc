// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: muscles in one dimension that are resumed from a checkpoint write the tables of a run that was not interrupted, byte for
// byte.

#include "../support/places.h"
#include "program_runner.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{
  /// A scene of input/one_dimensional, its step control left out: steps of 1 ms.
  std::string with_fixed_steps(const std::string &name)
  {
    std::string       scene = contents(myolines::test::source_folder() + "/input/one_dimensional/" + name);
    const std::size_t begin = scene.find("    <ParameterList name=\"control\">"),
                      end   = scene.find("  </ParameterList>\n  <ParameterList name=\"output\">");
    if (begin == std::string::npos || end == std::string::npos || end < begin)
      throw std::logic_error("the scene " + name + " has changed");
    return scene.erase(begin, end - begin);
  }

  void expect_same_after_resume(const std::string &scene, const std::string &settings, const std::string &table)
  {
    SCOPED_TRACE(settings);
    const TestFolder folder;
    folder.write("scene.xml", with_fixed_steps(scene));
    const auto run = [&](const std::string &out, const std::string &end, const std::string &more = "") {
      const Outcome outcome = run_program(
          folder, "run scene.xml --quiet --out " + out + " --set time/end=" + end +
                      " --set time/step=1e-3 --set output/checkpoint/every=10 --set output/checkpoint/seconds=0 " + settings + more);
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    };
    run("whole", "0.08");
    run("part", "0.05");
    run("part", "0.08", " --resume");
    for (const std::string &file : {table, std::string("steps.csv")})
      {
        EXPECT_EQ(contents(folder / ("whole/" + file)), contents(folder / ("part/" + file))) << file;
        EXPECT_GT(contents(folder / ("part/" + file)).size(), 1000u) << file;
      }
  }
} // namespace

TEST(ResumeOneDimensional, UnitsGoOnBitForBit)
{
  for (const std::string settings : {"integrator/type=sdirk3", "integrator/type=sdirk3 --set system/masses=0",
                                     "integrator/type=bdf2 --set system/masses=3 --set system/activation=unknown"})
    expect_same_after_resume("muscle_tendon_unit.xml", "--set output/series/interval=0.0025 --set " + settings, "muscle_tendon.csv");
}

TEST(ResumeOneDimensional, ChainsGoOnBitForBit)
{
  expect_same_after_resume("isometric_chain.xml", "--set output/stretches/interval=0.0025 --set integrator/type=sdirk3", "stretches.csv");
}
