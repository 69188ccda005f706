// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/study/discretisation_error.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines::study;

// Values x(h) = 2 + c h^p, whose error is known.

namespace
{
  constexpr double limit = 2;

  std::vector<Sample> power_law(const double c, const double p, const std::vector<double> &sizes = {0.4, 0.2, 0.1})
  {
    std::vector<Sample> samples;
    for (const double h : sizes)
      samples.push_back({h, limit + c * std::pow(h, p)});
    return samples;
  }

  double true_error(const Sample &sample) { return std::abs(sample.value - limit); }
} // namespace

/// At the rate of theory the error of the finest value is a quarter larger than the true one, and that of others less than that.
TEST(DiscretisationError, AtTheRateOfTheoryIsTheTrueOneAndAQuarterOfTheFinest)
{
  const auto samples = power_law(-3, 2);
  for (std::size_t which = 0; which < 3; ++which)
    {
      const DiscretisationError found = discretisation_error(samples, which, 2);
      EXPECT_EQ(found.approach, Approach::as_in_theory);
      EXPECT_NEAR(*found.rate, 2, 1e-9);
      EXPECT_NEAR(found.error, true_error(samples[which]) + 0.25 * true_error(samples[2]), 1e-9);
    }
}

/// Slower than theory, the observed rate is used, with a factor of 3; faster, that of theory.
TEST(DiscretisationError, AtAnotherRateIsCautious)
{
  const auto                slow    = power_law(1, 0.9);
  const DiscretisationError of_slow = discretisation_error(slow, 0, 2);
  EXPECT_EQ(of_slow.approach, Approach::at_another_rate);
  EXPECT_NEAR(*of_slow.assumed, 0.9, 1e-9);
  EXPECT_NEAR(of_slow.error, true_error(slow[0]) + 2 * true_error(slow[2]), 1e-9);

  const auto                fast    = power_law(1, 4);
  const DiscretisationError of_fast = discretisation_error(fast, 1, 2);
  EXPECT_EQ(of_fast.approach, Approach::at_another_rate);
  EXPECT_EQ(*of_fast.assumed, 2);
  EXPECT_GT(of_fast.error, true_error(fast[1]));
}

/// Two values: first order at most is taken, with a factor of 3, which covers rates from 0.5 on.
TEST(DiscretisationError, OfTwoValuesCoversHalfAnOrder)
{
  for (const double p : {0.5, 1., 2., 3.})
    {
      const auto                samples = power_law(1, p, {0.2, 0.1});
      const DiscretisationError found   = discretisation_error(samples, 0, 2);
      EXPECT_EQ(found.approach, Approach::unseen);
      EXPECT_FALSE(found.rate.has_value());
      EXPECT_NEAR(found.error, 4 * std::abs(samples[0].value - samples[1].value), 1e-12);
      EXPECT_GE(found.error, true_error(samples[0])) << p;
    }
}

TEST(DiscretisationError, OfValuesThatAlternateOrWander)
{
  const DiscretisationError alternating = discretisation_error({{4, 1.8}, {2, 2.1}, {1, 1.95}}, 1, 2);
  EXPECT_EQ(alternating.approach, Approach::alternating);
  EXPECT_NEAR(alternating.error, 0.15 + 3 * 0.15, 1e-12); // first order
  EXPECT_FALSE(alternating.rate.has_value());

  const DiscretisationError wandering = discretisation_error({{4, 1.9}, {2, 2}, {1, 2.2}}, 2, 2);
  EXPECT_EQ(wandering.approach, Approach::irregular);
  EXPECT_NEAR(wandering.error, 0.9, 1e-12);
  EXPECT_FALSE(wandering.assumed.has_value());

  const DiscretisationError none = discretisation_error({{4, 2}, {2, 2}, {1, 2}}, 0, 2);
  EXPECT_EQ(none.approach, Approach::at_once);
  EXPECT_EQ(none.error, 0);
}
