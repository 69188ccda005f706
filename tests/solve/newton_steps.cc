// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/solve/newton_steps.h>

#include <gtest/gtest.h>

using myolines::NewtonSteps;

TEST(NewtonSteps, sayNothingWithoutImportance)
{
  NewtonSteps steps;
  EXPECT_FALSE(steps.enough());
  steps.taken(std::nullopt);
  EXPECT_FALSE(steps.enough());
}

TEST(NewtonSteps, oneStepThatDoesNotMatterIsEnough)
{
  NewtonSteps small, large;
  small.taken(0.9);
  large.taken(1.1);
  EXPECT_TRUE(small.enough());
  EXPECT_FALSE(large.enough());
}

TEST(NewtonSteps, estimateWhatRemainsFromTheirRatio)
{
  NewtonSteps fast;
  fast.taken(100);
  fast.taken(9); // 0.09 / 0.91 * 9 = 0.89
  EXPECT_TRUE(fast.enough());

  NewtonSteps slow; // converges linearly with 0.9: after steps of 0.9 there are 8.1 to come
  slow.taken(1);
  slow.taken(0.9);
  EXPECT_FALSE(slow.enough());

  NewtonSteps diverging;
  diverging.taken(0.1);
  diverging.taken(0.2);
  EXPECT_FALSE(diverging.enough());
}

TEST(NewtonSteps, startAnewAfterAShortenedStep)
{
  NewtonSteps steps;
  steps.taken(100);
  steps.taken(std::nullopt);
  EXPECT_FALSE(steps.enough());
  steps.taken(2);
  EXPECT_FALSE(steps.enough());
  steps.taken(0.2);
  EXPECT_TRUE(steps.enough());
}
