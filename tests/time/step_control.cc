// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/solvers.h"

#include <myolines/base/error.h>
#include <myolines/time/plan.h>
#include <myolines/time/step_control.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  std::unique_ptr<StepControl> control(const Overrides &overrides) { return make_step_control(node(time_schema(), overrides)); }

  StepReport unsolved()
  {
    StepReport report;
    report.outcome = StepReport::Outcome::not_converged;
    report.reason  = "on demand";
    return report;
  }

  /// The message of the InputError that @p overrides cause, "" if none.
  std::string refusal(const Overrides &overrides)
  {
    try
      {
        control(overrides);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(Plan, endsAreMultiplesAndTheLastOneIsTheEnd)
{
  const Plan plan(0, 1, 0.1);
  double     t = 0;
  for (unsigned int k = 1; k <= 10; ++k)
    {
      const Plan::Step step = plan.at(t);
      EXPECT_EQ(step.end, k == 10 ? 1. : k * 0.1);
      EXPECT_EQ(step.size, 0.1);
      t = step.end;
    }
  EXPECT_EQ(plan.at(0.25).end, 3 * 0.1);
  EXPECT_EQ(plan.at(0.3 - 1e-14).end, 4 * 0.1) << "round-off before an end belongs to the next step";
}

// 1e8 steps: round-off of the time is more than a billionth of a step, and still every step ends later than it begins.
TEST(Plan, veryManyStepsGoOn)
{
  const double size = 1e-6 / 3;
  const Plan   plan(0, 1e8 * size, size);
  for (const double first : {1e6, 3e7, 9.9e7})
    {
      double t = first * size;
      for (int k = 0; k < 1000; ++k)
        {
          const Plan::Step step = plan.at(t);
          ASSERT_NEAR(step.begin, t, 1e-7 * size);
          ASSERT_NEAR(step.end, (first + k + 1) * size, 1e-7 * size);
          t = step.end;
        }
    }
}

TEST(Plan, lastStepIsShorterIfTheStepsDoNotFit)
{
  const Plan plan(1, 2, 0.3);
  EXPECT_EQ(plan.at(1.95).end, 2);
  EXPECT_EQ(plan.at(1.9 + 1e-6).size, 0.3);
}

TEST(Plan, followsASchedule)
{
  const auto          schedule = control({"end=0.2", "steps=4 x 0.025; 8 x 0.0125"});
  std::vector<double> ends;
  for (double t = 0; t < 0.2;)
    ends.push_back(t = schedule->next_landing(t));
  ASSERT_EQ(ends.size(), 12u);
  EXPECT_EQ(ends[3], 4 * 0.025);
  EXPECT_EQ(ends[4], 4 * 0.025 + 0.0125);
  EXPECT_EQ(ends.back(), 0.2);
}

TEST(StepControl, refusesContradictions)
{
  EXPECT_NE(refusal({"end=1"}).find("neither"), std::string::npos);
  EXPECT_NE(refusal({"end=1", "step=0.1", "steps=10 x 0.1"}).find("both"), std::string::npos);
  EXPECT_NE(refusal({"end=0.3", "steps=4 x 0.025; 8 x 0.0125"}).find("ends at 0.2 s"), std::string::npos);
  EXPECT_NE(refusal({"end=0.2", "steps=4 times 0.05"}).find("not a piece"), std::string::npos);
  EXPECT_NE(refusal({"end=0.2", "steps=0 x 0.05"}).find("not a piece"), std::string::npos);
  EXPECT_NE(refusal({"end=0.2", "steps=4 x -0.05"}).find("not a piece"), std::string::npos);
  EXPECT_NE(refusal({"end=-1", "step=0.1"}).find("end"), std::string::npos);
  EXPECT_NE(refusal({"end=1", "step=0"}), "");
  EXPECT_NE(refusal({"end=1", "step=0.1", "control/growth factor=0.5"}), "");
  EXPECT_EQ(refusal({"end=1", "step=0.1"}), "");
  EXPECT_EQ(refusal({"end=0.3", "steps=3 x 0.1"}), "") << "0.1 + 0.1 + 0.1 is 0.3 up to round-off";
}

TEST(StepControl, fixedGivesUpAtOnce)
{
  const auto fixed = control({"end=1", "step=0.1", "control/type=fixed"});
  EXPECT_EQ(fixed->propose(0), 0.1);
  EXPECT_FALSE(fixed->rejected(0, 0.1, unsolved()));
}

TEST(StepControl, cutBackHalvesGrowsAndStaysOnTheGridOfThePlan)
{
  const auto cut = control({"end=1", "step=0.125"});
  EXPECT_EQ(cut->propose(0), 0.125);
  ASSERT_TRUE(cut->rejected(0, 0.125, unsolved()));
  EXPECT_EQ(cut->propose(0), 0.0625);
  ASSERT_TRUE(cut->rejected(0, 0.0625, unsolved()));
  EXPECT_EQ(cut->propose(0), 0.03125);
  cut->accepted(0.03125, 0.03125, {});
  EXPECT_EQ(cut->propose(0.03125), 0.046875) << "two equal parts to the planned end";
  EXPECT_EQ(cut->next_landing(0.03125), 0.125);
  cut->accepted(0.078125, 0.046875, {});
  EXPECT_EQ(cut->propose(0.078125), 0.046875);
  cut->accepted(0.125, 0.046875, {});
  EXPECT_EQ(cut->propose(0.125), 0.125) << "the planned size again";
}

TEST(StepControl, cutBackHasLimits)
{
  const auto few = control({"end=1", "step=0.1", "control/maximum cuts=3"});
  double     dt  = 0.1;
  for (unsigned int cut = 1; cut <= 3; ++cut, dt /= 2)
    EXPECT_TRUE(few->rejected(0, dt, unsolved())) << cut;
  EXPECT_FALSE(few->rejected(0, dt, unsolved()));

  const auto coarse = control({"end=1", "step=0.1", "control/minimum step=0.04"});
  EXPECT_TRUE(coarse->rejected(0, 0.1, unsolved()));
  EXPECT_FALSE(coarse->rejected(0, 0.05, unsolved()));
}

TEST(StepControl, cutBackGivesUpBeforeRoundOffOfTheTimeDecides)
{
  const auto   cut = control({"end=1", "step=0.1", "control/maximum cuts=50"});
  const double t   = 0.5041477257601371;
  unsigned int n   = 0;
  for (double dt = 0.1; cut->rejected(t, dt, unsolved()); ++n)
    {
      dt = cut->propose(t);
      ASSERT_NEAR(t + dt - t, dt, dt / 4);
    }
  EXPECT_GT(n, 40u);
  EXPECT_LT(n, 50u);
}

TEST(StepControl, cutBackIsRestoredFromAnArchive)
{
  const auto first = control({"end=1", "step=0.1"}), second = control({"end=1", "step=0.1"});
  first->rejected(0, 0.1, unsolved());
  first->rejected(0, 0.05, unsolved());
  Archive archive;
  first->save(archive);
  second->load(archive);
  EXPECT_EQ(second->propose(0), first->propose(0));
  EXPECT_NE(second->propose(0), 0.1);
}

TEST(StepControl, cutsToEqualStepsWhereAMethodTakesNoLonger)
{
  const auto explicit_steps = control({"end=10", "step=0.1"});
  StepReport refused        = unsolved();
  refused.longest_step      = 0.03;
  ASSERT_TRUE(explicit_steps->rejected(0, 0.1, refused));
  double t = 0;
  for (unsigned int i = 1; i <= 20; ++i)
    {
      const double dt = explicit_steps->propose(t);
      EXPECT_NEAR(dt, 0.025, 1e-14) << t;
      explicit_steps->accepted(t, dt, StepReport());
      t = i % 4 == 0 ? 0.1 * (i / 4) : t + dt;
    }
}
