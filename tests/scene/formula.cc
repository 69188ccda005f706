// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/formula.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace myolines;

namespace
{
  VectorFormula formula_of(const std::string &x, const std::string &y, const std::string &fourth = "t")
  {
    return VectorFormula(std::array<std::string, 3>{{x, y, "0"}}, fourth);
  }

  std::string reason(const std::string &text)
  {
    try
      {
        formula_of("0", text);
      }
    catch (const std::invalid_argument &error)
      {
        return error.what();
      }
    return "";
  }

  TEST(Formula, KnowsPlaceTimeAndPi)
  {
    const dealii::Point<3> x(0.25, 2, -3);
    VectorFormula          formula = formula_of("sin(2*pi*x) + t", "x < 0.3 ? y : z");
    EXPECT_NEAR(formula(0, x, 0.5), std::sin(2 * std::acos(-1.) * 0.25) + 0.5, 1e-15);
    EXPECT_EQ(formula(1, x, 0), 2);
    EXPECT_EQ(formula(1, dealii::Point<3>(0.5, 2, -3), 0), -3);
    EXPECT_EQ(formula(0, dealii::Point<3>(), 7), 7) << "nothing is left of the point before";
    EXPECT_TRUE(formula.zero(2));
    EXPECT_FALSE(formula.zero(1));
    const VectorFormula moved = std::move(formula);
    EXPECT_EQ(moved(1, x, 0), 2);
    EXPECT_EQ(formula_of("volume", "0", "volume")(0, x, 4), 4);
  }

  TEST(Formula, RefusesWhatIsNotOne)
  {
    EXPECT_NE(reason("1 +").find("\"1 +\" is not a formula"), std::string::npos);
    EXPECT_NE(reason("volume").find("is not a formula"), std::string::npos) << "a variable that is not there";
    EXPECT_NE(reason("1,5").find("is a list"), std::string::npos);
    EXPECT_NE(reason("t = 3").find("assigns"), std::string::npos) << "the next formula would read it";
  }
} // namespace
