// SPDX-License-Identifier: LGPL-2.1-or-later
// Drives between samples, and their filters.
#include <myolines/system/sampled.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace myolines;

namespace
{
  std::vector<double> uneven(const unsigned int n, const double end)
  {
    std::vector<double> t;
    for (unsigned int i = 0; i < n; ++i)
      t.push_back(end * (i + 0.3 * std::sin(1.7 * i) * (i > 0 && i + 1 < n)) / (n - 1));
    return t;
  }

  std::vector<double> of(const std::vector<double> &t, const std::function<double(double)> &f)
  {
    std::vector<double> x;
    for (const double time : t)
      x.push_back(f(time));
    return x;
  }

  /// 0 and 1 in turn, for a quarter of a second each.
  double rectangle(const double t) { return std::fmod(t, 0.5) < 0.25 ? 0 : 1; }
} // namespace

TEST(SampledDrive, monotoneSlopesAreWeightedMeansOfTheChords)
{
  // chords 1 and 1/2 over 1 and 2: the longer interval weighs less
  EXPECT_NEAR(SampledDrive::monotone({0, 1, 3}, {0, 1, 2}).first_derivative(1, Side::right), 9. / 13, 1e-14);
}

TEST(SampledDrive, splineConvergesWithOrderFourInside)
{
  const auto error = [](const unsigned int n) {
    const auto         t      = uneven(n, 2);
    const SampledDrive spline = SampledDrive::spline(t, of(t, [](double x) { return std::sin(3 * x); }));
    double             worst  = 0;
    for (double x = 0.8; x < 1.2; x += 0.01)
      worst = std::max(worst, std::abs(spline.value(x, Side::left) - std::sin(3 * x)));
    return worst;
  };
  EXPECT_NEAR(std::log2(error(81) / error(161)), 4, 0.5);
}

TEST(SampledDrive, derivativesAreThoseOfTheValue)
{
  const auto         t = uneven(21, 2);
  const SampledDrive s = SampledDrive::spline(t, of(t, [](double x) { return std::sin(3 * x); }));
  for (double x = 0.013; x < 2; x += 0.0971)
    {
      const double h = 1e-5;
      EXPECT_NEAR((s.value(x + h, Side::left) - s.value(x - h, Side::left)) / (2 * h), s.first_derivative(x, Side::left), 1e-8);
      EXPECT_NEAR((s.first_derivative(x + h, Side::left) - s.first_derivative(x - h, Side::left)) / (2 * h),
                  s.second_derivative(x, Side::left), 1e-5);
    }
  EXPECT_EQ(s.kinks(-1, 3), (std::vector<double>{0, 2}));
  EXPECT_TRUE(s.kinks(0, 2).empty());
}

// The linear system of the smoothing spline keeps straight lines, and halves oscillations of the cut-off frequency.
TEST(SampledDrive, smoothsWhatIsFast)
{
  const auto t    = uneven(50, 3);
  const auto line = of(t, [](double x) { return 2 - 3 * x; }), filtered = spline_filtered(t, line, 0.1);
  for (unsigned int i = 0; i < t.size(); ++i)
    EXPECT_NEAR(filtered[i], line[i], 1e-11);

  std::vector<double> even;
  for (unsigned int i = 0; i <= 4000; ++i)
    even.push_back(i * 1e-3);
  for (const double ratio : {0.25, 1., 2.})
    {
      const double f    = 5 * ratio;
      const auto   wave = of(even, [f](double x) { return std::cos(2 * M_PI * f * x); });
      const auto   gain = [&](const std::vector<double> &x) { return x[2000] * std::cos(4 * M_PI * f); };
      EXPECT_NEAR(gain(spline_filtered(even, wave, 5)), 1 / (1 + std::pow(ratio, 4)), 2e-3) << "Butterworth's, at " << f << " Hz";
    }
}

TEST(SampledDrive, linesHaveSidesAndKinks)
{
  const SampledDrive s = SampledDrive::lines({0, 1, 3}, {1, 2, 0});
  EXPECT_EQ(s.value(2, Side::left), 1);
  EXPECT_EQ(s.first_derivative(1, Side::left), 1);
  EXPECT_EQ(s.first_derivative(1, Side::right), -1);
  EXPECT_EQ(s.kinks(0.5, 3), (std::vector<double>{1}));
  EXPECT_EQ(s.value(5, Side::left), 0);
  EXPECT_EQ(s.first_derivative(3, Side::right), 0);
}

TEST(SampledDrive, aSplineHasTheValuesAndRatesOfASine)
{
  const auto         t = uneven(400, 2);
  const SampledDrive s = SampledDrive::spline(t, of(t, [](double x) { return 0.5 + 0.4 * std::sin(2 * M_PI * x); }));
  for (double x = 0; x <= 2; x += 0.0317)
    {
      EXPECT_NEAR(s.value(x, Side::right), 0.5 + 0.4 * std::sin(2 * M_PI * x), 1e-7);
      EXPECT_NEAR(s.first_derivative(x, Side::right), 0.8 * M_PI * std::cos(2 * M_PI * x), 1e-4);
    }
  EXPECT_NEAR(s.extremes().greatest, 0.9, 1e-7);
  EXPECT_NEAR(s.extremes().least, 0.1, 1e-7);
}

TEST(SampledDrive, monotoneCubicsStayWhereTheSamplesAre)
{
  const auto         t = uneven(60, 2), x = of(t, rectangle);
  const SampledDrive spline = SampledDrive::spline(t, x), monotone = SampledDrive::monotone(t, x);
  EXPECT_GT(spline.extremes().greatest, 1.05);
  EXPECT_LT(spline.extremes().least, -0.05);
  EXPECT_EQ(monotone.extremes().greatest, 1);
  EXPECT_EQ(monotone.extremes().least, 0);
  EXPECT_TRUE(monotone.kinks(0, 2).empty());
  for (const double inside : t)
    if (inside > 0 && inside < 2)
      EXPECT_NEAR(monotone.first_derivative(inside, Side::left), monotone.first_derivative(inside, Side::right), 1e-12);
}
