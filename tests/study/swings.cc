// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/study/swings.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines::study;

namespace
{
  /// offset + slope t + a sin(omega t) at rows 0.01 apart until t = 2.
  Series wave(const double a, const double omega, const double slope = 0)
  {
    Series series;
    for (int i = 0; i <= 200; ++i)
      {
        series.t.push_back(0.01 * i);
        series.x.push_back(3 + slope * series.t.back() + a * std::sin(omega * series.t.back()));
      }
    return series;
  }
} // namespace

TEST(Swings, AreTheAmplitudeOfAWave)
{
  const double omega = 2 * M_PI / 0.1;
  for (const double t : {0., 0.03, 1.0, 1.234, 2.0})
    EXPECT_NEAR(amplitude_about(wave(0.2, omega), t, 0.4), 0.2 * std::sin(2 * M_PI / 5), 1e-6) << t; // rows are beside the peaks
}

/// One and a half periods are needed to be seen; a trend has none.
TEST(Swings, OfSlowMotionsAreNone)
{
  EXPECT_EQ(amplitude_about(wave(0.2, 2 * M_PI / 0.5), 1, 0.4), 0);
  EXPECT_EQ(amplitude_about(wave(0, 1, 5), 1, 0.4), 0);
  EXPECT_EQ(amplitude_about(wave(0.2, 2 * M_PI / 0.1, 1000), 1, 0.4), 0);
  EXPECT_EQ(amplitude_about({{0}, {1}}, 0, 1), 0);
  EXPECT_EQ(amplitude_about({}, 0, 1), 0);
}

/// Of a vibration that dies out the swings at the instant count, not the larger ones before.
TEST(Swings, AreThoseNearTheInstant)
{
  Series series = wave(0, 1);
  for (std::size_t i = 0; i < series.t.size(); ++i)
    series.x[i] = std::exp(-3 * series.t[i]) * std::cos(2 * M_PI * series.t[i] / 0.1);
  EXPECT_NEAR(amplitude_about(series, 2, 0.8), std::exp(-3 * 1.9), 0.1 * std::exp(-3 * 1.9)); // the middle one of the last three
  EXPECT_NEAR(amplitude_about(series, 0, 0.8), std::exp(-3 * 0.1), 0.1 * std::exp(-3 * 0.1));
}
