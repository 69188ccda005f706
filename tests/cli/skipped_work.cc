// SPDX-License-Identifier: LGPL-2.1-or-later
// What a scene does not need is not computed: the ledger of whole runs, and what `check` says of it.
#include "../support/places.h"
#include "program_runner.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace
{
  const std::string input = myolines::test::source_folder() + "/input/";

  const std::string small = " --set system/geometry/refinement=1 --set 'system/discretisation/quadrature points=3'"
                            " --set time/step=0.05 --set time/end=0.1";

  struct Counts
  {
    nlohmann::json counts;

    std::uint64_t of(const std::string &what) const { return counts.value(what, std::uint64_t(0)); }
  };

  Counts run(const std::string &arguments)
  {
    const TestFolder folder;
    const Outcome    outcome = run_program(folder, "run " + arguments + " --quiet --out out");
    if (outcome.exit_code != 0)
      throw std::runtime_error(outcome.err);
    return {nlohmann::json::parse(contents(folder / "out" / "ledger.json")).at("counts")};
  }

  std::string check(const std::string &arguments)
  {
    const TestFolder folder;
    return run_program(folder, "check " + arguments).out;
  }

  bool says(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

  const std::string no_series = " --set output/series/reactions=false --set output/series/forces=false --set output/series/energies=false"
                                " --set 'output/series/energy balance=false' --set 'output/series/stretch and pennation=false'"
                                " --set 'output/series/gearing info=false'";

  const std::string sweeps[] = {"residual", "stored tangent", "assembly"};
} // namespace

TEST(SkippedWork, APassiveMuscleHasNoActiveStressAndNoRates)
{
  const Counts passive = run(input + "passive_stretch.xml" + small), active = run(input + "isometric_block.xml" + small);
  for (const std::string &sweep : sweeps)
    for (const char *term : {"active stress in ", "force-velocity in "})
      EXPECT_EQ(passive.of(term + sweep), 0u) << term << sweep;
  EXPECT_GT(active.of("active stress in residual"), 0u);
  EXPECT_GT(active.of("force-velocity in residual"), 0u);
  const std::string told = check(input + "passive_stretch.xml" + small);
  EXPECT_TRUE(says(told, "off  active stress: no activation"));
  EXPECT_TRUE(says(told, "off  force-velocity: nothing is active"));
}

TEST(SkippedWork, AnActivationThatIsAlwaysZeroIsNoActivation)
{
  const std::string zero    = " --set 'system/activation/type=control points' --set 'system/activation/points=0 0; 1 0'";
  const Counts      without = run(input + "passive_stretch.xml" + small);
  EXPECT_EQ(without.counts, run(input + "passive_stretch.xml" + small + zero).counts);
}

TEST(SkippedWork, AnActivationThatIsZeroNowIsNotComputedNow)
{
  const std::string later = " --set 'system/activation/points=0 0; 0.1 0; 0.2 1'";
  const Counts      rest  = run(input + "isometric_block.xml" + small + later),
               whole      = run(input + "isometric_block.xml" + small + later + " --set time/end=0.15");
  for (const std::string &sweep : sweeps)
    EXPECT_EQ(rest.of("active stress in " + sweep), 0u) << sweep;
  EXPECT_GT(whole.of("active stress in residual"), 0u);
  EXPECT_TRUE(says(check(input + "isometric_block.xml" + later), "skipped while it is zero"));
}

TEST(SkippedWork, AQuasiStaticMuscleHasNoMassAndNoRates)
{
  const std::string still  = " --set system/inertia=quasi-static --set integrator/type=static";
  const Counts      counts = run(input + "isometric_block.xml" + small + still);
  EXPECT_GT(counts.of("active stress in residual"), 0u);
  for (const std::string &sweep : sweeps)
    for (const char *term : {"mass in ", "force-velocity in "})
      EXPECT_EQ(counts.of(term + sweep), 0u) << term << sweep;
  EXPECT_TRUE(says(check(input + "isometric_block.xml" + still), "off  inertia: quasi-static"));
}

TEST(SkippedWork, WithPMultigridNoMatrixOfTheFineLevelIsAssembled)
{
  const std::string p      = " --set 'solver/preconditioner/type=p multigrid'";
  const Counts      counts = run(input + "isometric_block.xml" + small + p);
  EXPECT_EQ(counts.of("matrix assemblies"), 0u);
  EXPECT_GT(counts.of("tangent actions"), counts.of("linear iterations"));
  EXPECT_TRUE(says(check(input + "isometric_block.xml" + p), "no matrix of the fine level is assembled"));
}

TEST(SkippedWork, PreconditionersAreKept)
{
  const Counts direct = run(input + "isometric_block.xml" + small + " --set solver/preconditioner/type=direct");
  EXPECT_LT(2 * direct.of("preconditioner set-ups"), direct.of("newton iterations"));
  EXPECT_EQ(direct.of("preconditioner set-ups"), direct.of("matrix assemblies"));
  EXPECT_TRUE(says(check(input + "isometric_block.xml"), "when keeping it has cost as much as a set-up"));
}

TEST(SkippedWork, NoResidualIsEvaluatedTwiceAtOneState)
{
  const Counts counts = run(input + "isometric_block.xml" + small + no_series);
  // at every trial, which is the right-hand side of the next direction too; the verdict takes one more where it is near
  const auto trials = counts.of("nonlinear solves") + counts.of("newton iterations") + counts.of("line search cuts");
  const auto taken  = counts.of("residual evaluations");
  EXPECT_GE(taken, trials);
  EXPECT_LE(taken, trials + counts.of("newton iterations") + counts.of("nonlinear solves"));
  EXPECT_EQ(counts.of("linearisations"), counts.of("newton iterations"));
}

TEST(SkippedWork, ALinearSceneIsFactoredOnce)
{
  const Counts counts = run(input + "rod_linear.xml --set output/checkpoint/every=1000000"); // a checkpoint makes solvers forget
  EXPECT_EQ(counts.of("accepted steps"), 500u);
  EXPECT_EQ(counts.of("linearisations"), 1u);
  EXPECT_EQ(counts.of("preconditioner set-ups"), 1u);
  EXPECT_TRUE(says(check(input + "rod_linear.xml"), "Jacobian: constant, made once"));
}

TEST(SkippedWork, OutputsNotAskedForCostNothing)
{
  const Counts counts = run(input + "isometric_block.xml" + small + no_series);
  for (const char *what : {"body measurements", "face force measurements", "reaction measurements"})
    EXPECT_EQ(counts.of(what), 0u) << what;
  const std::string told = check(input + "isometric_block.xml" + no_series);
  EXPECT_TRUE(says(told, "off  output series, reactions: not asked for"));
  EXPECT_TRUE(says(told, "off  output fields: not asked for"));
}

/// The energy balance is followed in time, the others are not.
TEST(SkippedWork, RareOutputsCostOnlyWhenWritten)
{
  const Counts rare = run(input + "isometric_block.xml" + small +
                          " --set time/step=0.01 --set output/series/every=5 --set 'output/series/energy balance=false'");
  EXPECT_EQ(rare.of("accepted steps"), 10u);
  EXPECT_EQ(rare.of("reaction measurements"), 3u);
}
