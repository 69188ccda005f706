// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: every registered method runs the muscle from one line of a scene, or is refused by name with a reason.

#include "../cli/program_runner.h"
#include "../support/places.h"

#include <myolines/time/integrator.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace myolines
{
  /// For the names of parameterised tests.
  inline void PrintTo(const IntegratorEntry &entry, std::ostream *stream) { *stream << entry.facts.name; }
} // namespace myolines

using namespace myolines;

namespace
{
  /// The kinked block on one cell, with the type of its integrator replaced.
  Outcome run(const MethodFacts &method, const std::string &end, const std::string &step, const std::string &more = "")
  {
    const TestFolder folder;
    return run_program(folder, "run '" + myolines::test::source_folder() +
                                   "/input/kinked_block.xml' --quiet --out out --set \"integrator/type=" + method.name +
                                   "\" --set time/end=" + end + " --set time/step=" + step + " --set system/geometry/refinement=0 " + more);
  }

  const std::string quasi_static = "--set system/inertia=quasi-static ";

  const std::string self_paced = "--set time/control/type=error --set \"time/boundary rates=exact\" --set time/events=restart ";

  void expect_refused(const Outcome &outcome, const MethodFacts &method, const std::string &reason)
  {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("\"" + method.name + "\" " + reason), std::string::npos) << outcome.err;
  }

  class EveryMethod : public ::testing::TestWithParam<IntegratorEntry>
  {
  };
} // namespace

TEST_P(EveryMethod, RunsTheDynamicMuscleOrSaysWhyNot)
{
  const MethodFacts &method = GetParam().facts;
  Outcome            outcome;
  if (!method.dynamic)
    return expect_refused(run(method, "0.2", "0.025"), method, "ignores inertia");
  if (GetParam().make_self_paced)
    {
      const std::string given = "--set \"time/boundary rates=scheme\" --set time/control/type=fixed"; // by the caller: nothing goes along
      expect_refused(run(method, "0.0625", "0.00625", given), method,
                     GetParam().make ? "has no formulas of its own for the rates of a moving boundary" : "chooses its steps itself");
      outcome = run(method, "0.0625", "0.001", GetParam().make ? self_paced : "--set time/events=restart");
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      return;
    }
  switch (method.solves)
    {
    case MethodFacts::Solves::nonlinear_equations:
      outcome = run(method, "0.0625", "0.00625");
      if (outcome.exit_code == 2) // not unconditionally stable, and the end moves by the rates of the scheme
        {
          EXPECT_NE(outcome.err.find("grows without bound under \"boundary rates\" = \"scheme\""), std::string::npos) << outcome.err;
          outcome = run(method, "0.0625", "0.00625", "--set \"time/boundary rates=exact\"");
        }
      break;
    case MethodFacts::Solves::linear_systems:
      outcome = run(method, "0.0625", "2e-4");
      break;
    case MethodFacts::Solves::mass:
      outcome = run(method, "0.0625", "0.00625", "--set time/control/type=fixed");
      EXPECT_EQ(outcome.exit_code, 3);
      EXPECT_NE(outcome.err.find("the stable step of \"" + method.name + "\""), std::string::npos) << outcome.err;
      outcome = run(method, "2e-6", "1e-7");
      break;
    }
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_P(EveryMethod, RunsTheQuasiStaticMuscleOrSaysWhyNot)
{
  const MethodFacts &method  = GetParam().facts;
  const Outcome      outcome = run(method, "0.1", "0.025", quasi_static + (GetParam().make ? "" : self_paced));
  using Unknowns             = MethodFacts::Unknowns;
  if (method.unknowns == Unknowns::second_order || method.unknowns == Unknowns::first_or_second_order)
    return expect_refused(outcome, method, "needs the acceleration of every unknown, but the system has no inertia");
  if (method.name == "newmark")
    return expect_refused(outcome, method, "carries accelerations on undamped, but the system has no inertia");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_P(EveryMethod, StandsInASceneOfTheInputFolder)
{
  std::string scenes;
  for (const auto &file : std::filesystem::directory_iterator(myolines::test::source_folder() + "/input"))
    scenes += contents(file.path());
  EXPECT_NE(scenes.find("\"integrator/type=" + GetParam().facts.name + "\""), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(registry, EveryMethod, ::testing::ValuesIn(integrator_registry()), [](const auto &info) {
  std::string name = info.param.facts.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
});
