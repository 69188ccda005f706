// SPDX-License-Identifier: LGPL-2.1-or-later
// Methods that solve but linear systems, where hardly anything is left to solve.
#include "program_runner.h"

#include <gtest/gtest.h>

/// What is left of the forces then is rounding, below which no linear solver gets.
TEST(AtRest, AMuscleThatHoldsAWeightFromEquilibriumGoesOn)
{
  const TestFolder folder;
  for (const std::string method : {"rosenbrock", "imex euler"})
    {
      const Outcome outcome = run_program(folder, "run " + myolines::test::source_folder() +
                                                      "/input/isotonic_shortening.xml --set system/geometry/refinement=0 --set "
                                                      "system/activation/type=constant --set system/activation/value=0.35 --set "
                                                      "time/end=0.05 --set 'integrator/type=" +
                                                      method + "' --out '" + method + "'");
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_NE(outcome.out.find(" 0 rejected"), std::string::npos) << outcome.out;
    }
}
