// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/solvers.h"

#include <myolines/base/error.h>
#include <myolines/time/error_control.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  constexpr double inf = std::numeric_limits<double>::infinity();

  /// safety 1, so that numbers are those of the formulas; k = 2.
  ErrorControlLimits limits() { return {0.1, 0, inf, 1, 4, 3}; }

  StepReport with_error(const double error)
  {
    StepReport report;
    ErrorNorm::judge(error, report);
    return report;
  }

  StepReport failed()
  {
    StepReport report;
    report.outcome = StepReport::Outcome::not_converged;
    return report;
  }
} // namespace

TEST(ErrorControl, firstStepIsTheGivenOneAndNothingIsLandedOn)
{
  const ErrorControl control(limits(), 2);
  EXPECT_EQ(control.propose(0), 0.1);
  EXPECT_EQ(control.next_landing(0), inf);
}

TEST(ErrorControl, isAPiController)
{
  ErrorControl control(limits(), 2);
  control.accepted(0.1, 0.1, with_error(0.25));
  const double first = 0.1 * std::pow(0.25, -0.35);
  EXPECT_DOUBLE_EQ(control.propose(0.1), first) << "without memory only the integral part";
  control.accepted(0.3, first, with_error(0.7));
  EXPECT_DOUBLE_EQ(control.propose(0.3), first) << "less than a fifth more is not worth a new matrix";
  control.accepted(0.5, first, with_error(0.1));
  EXPECT_DOUBLE_EQ(control.propose(0.5), first * std::pow(0.1, -0.35) * std::pow(7, 0.1));
}

TEST(ErrorControl, shrinksByTheErrorAndNotBelowAFifth)
{
  ErrorControl control(limits(), 2);
  ASSERT_TRUE(control.rejected(0, 0.1, with_error(4)));
  EXPECT_DOUBLE_EQ(control.propose(0), 0.05);
  control.accepted(0.05, 0.05, with_error(1));
  ASSERT_TRUE(control.rejected(0, 0.05, with_error(1e9)));
  EXPECT_DOUBLE_EQ(control.propose(0), 0.01);
  control.accepted(0.01, 0.01, with_error(1e-5));
  EXPECT_DOUBLE_EQ(control.propose(0.01), 0.01) << "no growth after a rejection";
  control.accepted(0.02, 0.01, with_error(1e-5));
  EXPECT_DOUBLE_EQ(control.propose(0.02), 0.04) << "the growth limit";
}

TEST(ErrorControl, learnsFromTwoErrorsTooLargeHowTheyFall)
{
  ErrorControl control(limits(), 2);
  ASSERT_TRUE(control.rejected(0, 0.1, with_error(4)));
  ASSERT_TRUE(control.rejected(0, 0.05, with_error(2))) << "like dt, not dt^2";
  EXPECT_DOUBLE_EQ(control.propose(0), 0.025);
  ErrorControl constant(limits(), 2);
  ASSERT_TRUE(constant.rejected(0, 0.1, with_error(4)));
  ASSERT_TRUE(constant.rejected(0, 0.05, with_error(5))) << "not at all";
  EXPECT_DOUBLE_EQ(constant.propose(0), 0.01);
}

TEST(ErrorControl, quartersAStepThatFailed)
{
  ErrorControl control(limits(), 2);
  ASSERT_TRUE(control.rejected(0, 0.1, failed()));
  EXPECT_DOUBLE_EQ(control.propose(0), 0.025);
}

TEST(ErrorControl, landingsDoNotShortenTheNextStep)
{
  ErrorControl control(limits(), 2);
  control.accepted(0.001, 0.001, with_error(0.9));
  EXPECT_DOUBLE_EQ(control.propose(0.001), 0.1);
}

TEST(ErrorControl, hasLimits)
{
  ErrorControlLimits small = limits();
  small.minimum_step       = 0.04;
  ErrorControl coarse(small, 2);
  EXPECT_TRUE(coarse.rejected(0, 0.1, with_error(4)));
  EXPECT_FALSE(coarse.rejected(0, 0.05, with_error(4)));

  ErrorControl stubborn(limits(), 2);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_TRUE(stubborn.rejected(0, 0.1, failed()));
  EXPECT_FALSE(stubborn.rejected(0, 0.1, failed()));

  ErrorControlLimits large = limits();
  large.maximum_step       = 0.15;
  ErrorControl bounded(large, 2);
  bounded.accepted(0.1, 0.1, with_error(0.01));
  EXPECT_EQ(bounded.propose(0.1), 0.15);
}

TEST(ErrorControl, isRestoredFromAnArchiveAndStartsAnewFromThatOfAnother)
{
  ErrorControl first(limits(), 2), second(limits(), 2);
  first.accepted(0.1, 0.1, with_error(0.2));
  first.accepted(0.2, 0.1, with_error(0.3));
  Archive archive;
  first.save(archive);
  second.load(archive);
  EXPECT_EQ(second.propose(0), first.propose(0));
  for (ErrorControl *control : {&first, &second})
    control->accepted(0.3, 0.1, with_error(0.1));
  EXPECT_EQ(second.propose(0), first.propose(0));

  ErrorControl other(limits(), 2);
  other.load(Archive());
  EXPECT_EQ(other.propose(0), 0.1);
}

TEST(ErrorControl, refusesContradictions)
{
  const auto refusal = [](const Overrides &more) -> std::string {
    Overrides settings = {"end=1", "control/type=error"};
    settings.insert(settings.end(), more.begin(), more.end());
    try
      {
        make_step_control(node(time_schema(), settings), 2);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  };
  EXPECT_EQ(refusal({"step=0.1"}), "");
  EXPECT_NE(refusal({}).find("first step"), std::string::npos);
  EXPECT_NE(refusal({"steps=10 x 0.1"}).find("steps"), std::string::npos);
  EXPECT_NE(refusal({"step=0.1", "control/minimum step=0.2"}).find("minimum step"), std::string::npos);
  EXPECT_NE(refusal({"step=0.1", "control/growth factor=1"}), "");
  EXPECT_NE(refusal({"step=0.1", "control/displacement/relative tolerance=2"}), "");
}

TEST(Judge, refusesErrorsBeyondTheTolerance)
{
  EXPECT_TRUE(with_error(1).accepted());
  EXPECT_EQ(with_error(1.01).outcome, StepReport::Outcome::error_too_large);
  EXPECT_EQ(with_error(3).error_estimate, 3);
}
