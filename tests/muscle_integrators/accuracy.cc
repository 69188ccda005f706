// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: methods in the muscle are as accurate, and ring as much, as an independent program has found.

#include "measured_run.h"
#include "study.h"

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

TEST(KinkedBlock, ErrorsAndRingingAreThoseOfTheStudyToTheDigitsPrinted)
{
  const MeasuredRun reference = kinked_run(scheme("sdirk3"), steps_of_reference(1), 1);
  for (const Scheme &scheme : schemes())
    for (const StudyEntry &theirs : study(1, scheme.name))
      {
        if (theirs.n > 32)
          break;
        SCOPED_TRACE(scheme.name + ", " + std::to_string(theirs.n) + " steps");
        const MeasuredRun run = kinked_run(scheme, theirs.n, 1);
        const double error = relative_error(run.u, reference.u), variation = relative_variation(run.mid_velocity, reference.mid_velocity);
        EXPECT_TRUE(same_digits(error, theirs.error)) << error << " and " << theirs.error;
        EXPECT_NEAR(variation, theirs.variation, 0.011);
        if (!theirs.velocity_error)
          continue;
        const double velocity_error = relative_error(run.v, reference.v);
        EXPECT_TRUE(same_digits(velocity_error, *theirs.velocity_error)) << velocity_error << " and " << *theirs.velocity_error;
      }
}

TEST(IsometricBlock, AThirdOrderMethodIsFiftyTimesAsAccurateAsBackwardEuler)
{
  const auto run = [](const std::string &name, const std::string &step) {
    Overrides overrides = scheme(name).parameters;
    overrides.insert(overrides.end(), {"system/geometry/refinement=2", "time/step=" + step});
    return measured_run("isometric_block.xml", overrides).u;
  };
  const Vector reference = run("sdirk3", "0.00625");
  const double third = relative_error(run("sdirk3", "0.025"), reference), first = relative_error(run("be", "0.025"), reference);
  EXPECT_GT(first, 50 * third) << first << " and " << third;
  RecordProperty("ratio",
                 std::to_string(first / third) + " = " + std::to_string(1e6 * first) + "e-6/" + std::to_string(1e6 * third) + "e-6");
}
