// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/matrices.h"

#include <myolines/system/archive.h>

#include <gtest/gtest.h>

#include <limits>

using namespace myolines;
using namespace myolines::testing;

TEST(Archive, keepsNumbersAndVectorsBitForBit)
{
  const std::vector<double> odd = {0.1, -0., 1e-310, std::numeric_limits<double>::infinity(), 1 / 3.};
  Vector                    x   = serial_vector(odd.size());
  std::copy(odd.begin(), odd.end(), x.begin());

  Archive archive;
  archive.put("size", 1 / 3.);
  archive.put("u", x);
  x = 0;
  EXPECT_EQ(archive.number("size"), 1 / 3.);
  archive.read("u", x);
  EXPECT_EQ(std::vector<double>(x.begin(), x.end()), odd);
  EXPECT_TRUE(std::signbit(x(1)));
}

TEST(Archive, refusesUnknownNamesAndOtherLayouts)
{
  Archive archive;
  archive.put("u", serial_vector(3));
  Vector other = serial_vector(4);
  EXPECT_THROW(archive.number("v"), std::out_of_range);
  EXPECT_THROW(archive.read("v", other), std::out_of_range);
  EXPECT_THROW(archive.read("u", other), std::exception);
}

TEST(Archive, laterValuesReplaceEarlierOnes)
{
  Archive archive;
  archive.put("cuts", 1);
  archive.put("cuts", 2);
  EXPECT_EQ(archive.number("cuts"), 2);
  EXPECT_EQ(archive.all_numbers().size(), 1u);
}

TEST(Archive, tellsNumbersFromVectors)
{
  // A vector of one entry is no number: the ranks share the former, and all have the latter.
  Archive archive;
  archive.put("x", serial_vector(1));
  archive.put_numbers("times", {0, 0.5});
  EXPECT_FALSE(archive.has_numbers("x"));
  EXPECT_THROW(archive.number("x"), std::out_of_range);
  EXPECT_TRUE(archive.has_numbers("times"));
  EXPECT_EQ(archive.numbers("times"), (std::vector<double>{0, 0.5}));
  EXPECT_EQ(archive.all_vectors().size(), 1u);
}
