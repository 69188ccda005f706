// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/sine_cosine.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace myolines
{
  namespace
  {
    using Wide = Lanes<InstructionSet::avx512>; // compiled for what this file is compiled for

    double first(const double x) { return x; }
    double first(const Wide &x) { return x[0]; }

    template <typename T>
    void compare_sines_and_cosines()
    {
      std::minstd_rand random(1);
      for (const double range : {1., 60., 1e5})
        for (int k = 0; k < 20000; ++k)
          {
            const double x  = std::uniform_real_distribution<double>(-range, range)(random);
            const auto   at = sine_and_cosine(T(x));
            EXPECT_NEAR(first(at.sine), double(std::sin(static_cast<long double>(x))), 5e-16) << x;
            EXPECT_NEAR(first(at.cosine), double(std::cos(static_cast<long double>(x))), 5e-16) << x;
          }
      EXPECT_TRUE(std::isnan(first(sine_and_cosine(T(std::numeric_limits<double>::quiet_NaN())).sine)));
    }

    template <typename T>
    void compare_cube_roots()
    {
      std::minstd_rand random(1);
      for (int k = 0; k < 20000; ++k)
        {
          const double size = std::pow(10., std::uniform_real_distribution<double>(-300, 300)(random));
          for (const double x : {size, -size})
            EXPECT_NEAR(first(cbrt(T(x))) / std::cbrt(x), 1, 1e-15) << x;
        }
      EXPECT_EQ(first(cbrt(T(0.))), 0);
      EXPECT_TRUE(std::isnan(first(cbrt(T(std::numeric_limits<double>::quiet_NaN())))));
    }

  } // namespace

  TEST(Functions, SineAndCosineAreThoseOfExtendedPrecision)
  {
    compare_sines_and_cosines<double>();
    compare_sines_and_cosines<Wide>();
  }

  TEST(Functions, SineAndCosineOfFloats)
  {
    for (float x = -100; x < 100; x += 0.1f)
      {
        const auto at = sine_and_cosine(Lanes<InstructionSet::baseline, float>(x));
        EXPECT_NEAR(at.sine[0], std::sin(double(x)), 3e-7) << x;
        EXPECT_NEAR(at.cosine[0], std::cos(double(x)), 3e-7) << x;
      }
  }

  TEST(Functions, CubeRootsHaveAllDigitsAtAnySize)
  {
    compare_cube_roots<double>();
    compare_cube_roots<Wide>();
  }

  TEST(Functions, CubeRootsOfEachLane)
  {
    Wide x(0.);
    for (int lane = 0; lane < Wide::size; ++lane)
      x.set(lane, (lane - 3.) * (lane - 3.) * (lane - 3.));
    const Wide root = cbrt(x);
    for (int lane = 0; lane < Wide::size; ++lane)
      EXPECT_NEAR(root[lane], lane - 3., 1e-14);
  }
} // namespace myolines
