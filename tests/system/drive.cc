// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/temporary.h"

#include <myolines/system/drive.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace myolines;

namespace
{
  using Settings = std::vector<scene::Setting>;

  std::unique_ptr<Drive> drive(const Settings &settings) { return make_drive(scene::compose_scene(drive_schema("strain", "-"), settings)); }

  std::unique_ptr<Drive> points(const std::string &text, const std::string &type = "control points")
  {
    return drive({{"type", type}, {"points", text}});
  }

  std::string refusal(const Settings &settings)
  {
    try
      {
        drive(settings);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "accepted";
  }

  /// Central differences of value and first derivative at @p t against the derivatives.
  void expect_derivatives(const Drive &d, const double t, const double scale)
  {
    const double h = 1e-5;
    EXPECT_NEAR(d.first_derivative(t), (d.value(t + h) - d.value(t - h)) / (2 * h), 1e-7 * scale) << t;
    EXPECT_NEAR(d.second_derivative(t), (d.first_derivative(t + h) - d.first_derivative(t - h)) / (2 * h), 1e-6 * scale) << t;
  }
} // namespace

TEST(Drive, Constant)
{
  const auto d = drive({{"value", "0.3"}});
  EXPECT_EQ(d->value(-5), 0.3);
  EXPECT_EQ(d->first_derivative(2), 0);
  EXPECT_TRUE(d->kinks(-1e9, 1e9).empty());
  EXPECT_FALSE(d->identically_zero());
  EXPECT_TRUE(drive({})->identically_zero());
}

TEST(Drive, ControlPointsAreLinearBetweenAndConstantOutside)
{
  const auto d = points("0.1 0; 0.3 1; 0.5 1; 0.7 -1;");
  EXPECT_EQ(d->value(0), 0);
  EXPECT_NEAR(d->value(0.15), 0.25, 1e-15);
  EXPECT_EQ(d->value(0.4), 1);
  EXPECT_NEAR(d->value(0.6), 0, 1e-15);
  EXPECT_EQ(d->value(9), -1);
  EXPECT_NEAR(d->first_derivative(0.2), 5, 1e-13);
  EXPECT_NEAR(d->first_derivative(0.3, Side::left), 5, 1e-13);
  EXPECT_EQ(d->first_derivative(0.3, Side::right), 0);
  EXPECT_NEAR(d->first_derivative(0.7, Side::left), -10, 1e-12);
  EXPECT_EQ(d->first_derivative(0.7, Side::right), 0);
  EXPECT_EQ(d->second_derivative(0.3, Side::right), 0);
  EXPECT_EQ(d->kinks(0, 1), (std::vector<double>{0.1, 0.3, 0.5, 0.7}));
  EXPECT_EQ(d->kinks(0.1, 0.5), std::vector<double>{0.3}) << "the interval is open";
  EXPECT_NEAR(drive({{"type", "control points"}, {"points", "0 0; 1 2"}, {"scale", "0.5"}})->value(0.5), 0.5, 1e-15);
}

TEST(Drive, ATimeRoundedBesideAKinkIsAtTheKink)
{
  const auto d = points("0 0; 0.3 1");
  for (const double t : {0.1 + 0.2, 0.3, std::nextafter(0.3, 0.), 0.3 - 2e-16})
    {
      EXPECT_GT(d->first_derivative(t, Side::left), 3) << t;
      EXPECT_EQ(d->first_derivative(t, Side::right), 0) << t;
    }
  EXPECT_TRUE(d->kinks(0, std::nextafter(0.3, 1.)).empty());
  EXPECT_TRUE(d->kinks(std::nextafter(0.3, 0.), 1).empty());
  EXPECT_GT(d->first_derivative(0.3 - 1e-9, Side::right), 3) << "further away the side does not matter";
}

TEST(Drive, PointsOnALineAreNoKinks)
{
  EXPECT_EQ(points("0 0; 0.1 0.1; 0.2 0.2; 0.3 0.3")->kinks(-1, 1), (std::vector<double>{0, 0.3}));
  EXPECT_TRUE(points("0 1; 1 1")->kinks(-1, 2).empty());
  EXPECT_TRUE(points("0 0; 1 0")->identically_zero());
  EXPECT_EQ(points("0.2 4")->value(0.7), 4) << "one point is a constant";
}

TEST(Drive, SplineThroughACubicWithFlatEndsIsThatCubic)
{
  // t^2 (3 - 2 t) has zero slope at 0 and 1, so the clamped spline reproduces it
  const auto d = points("0 0; 0.25 0.15625; 0.5 0.5; 1 1", "spline");
  for (const double t : {0.1, 0.25, 0.3, 0.77, 0.99})
    {
      EXPECT_NEAR(d->value(t), t * t * (3 - 2 * t), 1e-14);
      EXPECT_NEAR(d->first_derivative(t), 6 * t * (1 - t), 1e-13);
      EXPECT_NEAR(d->second_derivative(t), 6 - 12 * t, 1e-12);
    }
  EXPECT_EQ(d->value(-1), 0);
  EXPECT_EQ(d->value(2), 1);
  EXPECT_EQ(d->kinks(-1, 2), (std::vector<double>{0, 1}));
  EXPECT_NEAR(d->second_derivative(1, Side::left), -6, 1e-12);
  EXPECT_EQ(d->second_derivative(1, Side::right), 0);
}

TEST(Drive, SplineIsTwiceContinuouslyDifferentiable)
{
  const auto d = points("0 0; 0.1 0.4; 0.35 -0.2; 0.4 0.1; 1 0.3", "spline");
  for (const double t : {0.1, 0.35, 0.4})
    {
      EXPECT_NEAR(d->value(t, Side::left), d->value(t, Side::right), 1e-14);
      EXPECT_NEAR(d->first_derivative(t, Side::left), d->first_derivative(t, Side::right), 1e-12);
      EXPECT_NEAR(d->second_derivative(t, Side::left), d->second_derivative(t, Side::right), 1e-9);
    }
  EXPECT_NEAR(d->value(0.35), -0.2, 1e-15);
  EXPECT_NEAR(d->first_derivative(1, Side::left), 0, 1e-13);
  for (const double t : {0.05, 0.2, 0.38, 0.7})
    expect_derivatives(*d, t, 100);
}

TEST(Drive, RampOfTheThesis)
{
  const auto d = drive({{"type", "ramp"}, {"amplitude", "0.1"}, {"start", "0.1"}, {"duration", "0.5"}});
  EXPECT_EQ(d->value(0.05), 0);
  EXPECT_NEAR(d->value(0.35), 0.05, 1e-16);
  EXPECT_EQ(d->value(2), 0.1);
  EXPECT_NEAR(d->first_derivative(0.1, Side::right), 0.2, 1e-15);
  EXPECT_EQ(d->kinks(0, 2), (std::vector<double>{0.1, 0.6}));
}

TEST(Drive, SmoothStepOfTheThesis)
{
  // A = 0.1, T = 2, greatest rate 0.2, hence c0 = 0.5
  const auto   d   = drive({{"type", "smooth step"}, {"amplitude", "0.1"}, {"duration", "2"}, {"maximum rate", "0.2"}});
  const auto   psi = [](const double x) { return std::exp(-1 / (0.5 * x)); };
  const double x   = 0.3;
  EXPECT_NEAR(d->value(2 * x), 0.1 * psi(x) / (psi(x) + psi(1 - x)), 1e-16);
  EXPECT_NEAR(d->first_derivative(1), 0.2, 1e-15);
  for (double t = 0.01; t < 2; t += 0.01)
    {
      EXPECT_LE(d->first_derivative(t), 0.2 + 1e-15);
      expect_derivatives(*d, t, 1);
    }
  EXPECT_EQ(d->value(0), 0);
  EXPECT_EQ(d->value(2), 0.1);
  for (const double t : {-1., 0., 1e-300, 1e-3, 1.999999, 2., 3.})
    {
      EXPECT_NEAR(d->first_derivative(t), 0, 1e-12);
      EXPECT_NEAR(d->second_derivative(t), 0, 1e-12);
    }
  EXPECT_TRUE(d->kinks(-1, 3).empty());
}

TEST(Drive, SineOfTheThesis)
{
  const auto   d  = drive({{"type", "sine"}, {"amplitude", "0.1"}, {"frequency", "2"}, {"phase", "90"}, {"offset", "1"}});
  const double pi = 3.14159265358979323846;
  for (const double t : {0., 0.13, 0.4})
    {
      EXPECT_NEAR(d->value(t), 1 + 0.1 * std::cos(4 * pi * t), 1e-15);
      EXPECT_NEAR(d->first_derivative(t), -0.4 * pi * std::sin(4 * pi * t), 1e-13);
      EXPECT_NEAR(d->second_derivative(t), -1.6 * pi * pi * std::cos(4 * pi * t), 1e-12);
    }
}

TEST(Drive, PowersHaveAKinkOnlyWhereASecondDerivativeJumps)
{
  const auto d = drive({{"type", "power"}, {"amplitude", "0.2"}, {"start", "0.1"}, {"exponent", "3"}});
  EXPECT_EQ(d->value(0.05), 0);
  EXPECT_NEAR(d->value(0.6), 0.2 * 0.125, 1e-16);
  expect_derivatives(*d, 0.6, 1);
  EXPECT_TRUE(d->kinks(0, 1).empty());
  const auto square = drive({{"type", "power"}, {"amplitude", "2"}, {"start", "0.1"}, {"exponent", "2"}});
  EXPECT_EQ(square->kinks(0, 1), std::vector<double>{0.1});
  EXPECT_EQ(square->second_derivative(0.1, Side::left), 0);
  EXPECT_EQ(square->second_derivative(0.1, Side::right), 4);
}

TEST(Drive, BadPointsAreRefused)
{
  const auto of = [](const std::string &text) { return refusal({{"type", "control points"}, {"points", text}}); };
  EXPECT_NE(of("0 0; 0.2 1; 0.1 2").find("unsorted: time 0.1 of control point 3 follows time 0.2"), std::string::npos);
  EXPECT_NE(of("0 0; 0 1").find("unsorted"), std::string::npos) << "a jump";
  EXPECT_NE(of("0 nan; 1 1").find("\"nan\" is not a finite number"), std::string::npos);
  EXPECT_NE(of("0 0; inf 1").find("\"inf\""), std::string::npos);
  EXPECT_NE(of("0 0; 1").find("\"1\" is not a control point"), std::string::npos);
  EXPECT_NE(of("0 0 0").find("is not a control point"), std::string::npos);
  EXPECT_NE(of(" ; ").find("no control point"), std::string::npos);
  EXPECT_NE(refusal({{"type", "spline"}}).find("neither"), std::string::npos);
  EXPECT_NE(refusal({{"type", "smooth step"}, {"amplitude", "1"}, {"duration", "1"}, {"maximum rate", "1.5"}}).find("maximum rate"),
            std::string::npos);
  EXPECT_NE(refusal({{"type", "ramp"}, {"amplitude", "1"}, {"start", "1"}, {"duration", "1e-15"}}).find("duration"), std::string::npos);
}

TEST(Drive, PointsFromAFile)
{
  const std::filesystem::path file = test::temporary("drive_test.dat");
  std::ofstream(file) << "# t strain\n0.0\t0.0\n\n0.2 \t0.5\r\n";
  const auto d = drive({{"type", "control points"}, {"file", file.string()}});
  EXPECT_EQ(d->value(0.1), 0.25);
  EXPECT_NE(refusal({{"type", "control points"}, {"file", file.string()}, {"points", "0 0"}}).find("both"), std::string::npos);
  std::ofstream(file) << "0 0\n1 x\n";
  EXPECT_NE(refusal({{"type", "control points"}, {"file", file.string()}}).find("line 2: \"x\" is not a finite number"), std::string::npos);
  std::filesystem::remove(file);
}
