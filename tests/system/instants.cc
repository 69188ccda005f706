// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: one rule says which times are the same instant.

#include <myolines/system/instants.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace myolines;

TEST(Instants, TimesThatDifferByRoundingAreOne)
{
  for (const double t : {0.3, -0.3, 1e10, -1e10, 1e-9})
    {
      for (const double towards : {-1e300, 1e300})
        EXPECT_TRUE(same_time(t, std::nextafter(t, towards))) << t;
      EXPECT_FALSE(same_time(t, t * (1 + 1e-14))) << t;
    }
  EXPECT_TRUE(same_time(0.1 + 0.2, 0.3));
  EXPECT_TRUE(same_time(1, 1 + 1e-12, 0.01)) << "beside steps of 10 ms";
  EXPECT_FALSE(same_time(1, 1 + 1e-10, 0.01));
  EXPECT_TRUE(same_time(0, 0));
  EXPECT_FALSE(same_time(0.3, std::numeric_limits<double>::infinity())) << "where no instant follows";
}

TEST(Instants, AtTheSameInstantTheSideDecides)
{
  for (const double t : {std::nextafter(0.3, 0.), 0.3, std::nextafter(0.3, 1.)})
    {
      EXPECT_FALSE(has_begun(0.3, t, Side::left, time_tolerance(0.3)));
      EXPECT_TRUE(has_begun(0.3, t, Side::right, time_tolerance(0.3)));
    }
  EXPECT_FALSE(has_begun(0.3, 0.3 - 1e-9, Side::right, time_tolerance(0.3)));
  EXPECT_TRUE(has_begun(0.3, 0.3 + 1e-9, Side::left, time_tolerance(0.3)));
}

TEST(Instants, OneListHasTheLastOfEqualOnes)
{
  EXPECT_EQ(one_list({0.7, 0.1 + 0.2, 0.3, 0.1}), (std::vector<double>{0.1, 0.1 + 0.2, 0.7}));
  EXPECT_TRUE(one_list({}).empty());
}
