// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/numbers.h>
#include <myolines/scene/schema.h>

#include <gtest/gtest.h>

#include <limits>

using namespace myolines::scene;

TEST(Numbers, ParseCompletelyOrNotAtAll)
{
  EXPECT_EQ(parse_number("1e-3"), 1e-3);
  EXPECT_EQ(parse_number(" +.5\n"), 0.5);
  EXPECT_EQ(parse_number("-2."), -2.);
  for (const char *text : {"", " ", "abc", "1,5", "1 2", "0x10", "+-1", "nan", "-inf", "1e400", "--1"})
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
  EXPECT_EQ(parse_integer("-3"), -3);
  for (const char *text : {"", "1.0", "3000000000", "1e2"})
    EXPECT_EQ(parse_integer(text), std::nullopt) << text;
}

TEST(Numbers, FormatIsExactAndShort)
{
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(200000), "200000");
  EXPECT_EQ(format_number(1e7), "1e+07");
  for (const double value :
       {1. / 3, 0.1 + 0.2, 1e-300, std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(), -0.1990559575103343})
    EXPECT_EQ(parse_number(format_number(value)).value_or(0), value);
}

TEST(Range, ContainsAndText)
{
  EXPECT_FALSE(Range::positive().contains(0));
  EXPECT_TRUE(Range::not_negative().contains(0));
  EXPECT_TRUE(Range::closed(1, 3).contains(3));
  EXPECT_EQ(Range::positive().text(), "> 0");
  EXPECT_EQ(Range::closed(0, 1).text(), "in [0, 1]");
  EXPECT_EQ((Range{0, 1, true, false}).text(), "in (0, 1]");
  EXPECT_EQ(Range::any().text(), "any finite number");
}
