// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/matrices.h"
#include "folder.h"

#include <myolines/output/dense_output.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;

namespace
{
  Vector vector(const double value)
  {
    Vector x = myolines::testing::serial_vector(1);
    x(0)     = value;
    return x;
  }

  /// u = t^3 - 2 t + 1
  State cubic(const double t) { return {t, vector(t * t * t - 2 * t + 1), vector(3 * t * t - 2), vector(6 * t)}; }

  State sine(const double t) { return {t, vector(std::sin(t)), vector(std::cos(t)), vector(-std::sin(t))}; }

  /// Notes what it is asked to write.
  struct Notes : DenseOutput
  {
    Notes(const double interval, const OutputFolder &folder, const bool inertia = true)
      : DenseOutput(multiples_of(interval), "rows", folder, inertia)
    {}
    void write(const double t, const State &state) override
    {
      times.push_back(t);
      values.push_back(state.u(0));
    }
    std::vector<double> times, values;
  };

  StepRecord step(const double t, const double dt)
  {
    StepRecord record;
    record.t  = t;
    record.dt = dt;
    return record;
  }
} // namespace

TEST(DenseOutput, interpolatesCubicsExactlyAndOthersToFourthOrder)
{
  const State between = interpolate(cubic(0.5), cubic(1.3), 0.9, true);
  EXPECT_EQ(between.t, 0.9);
  EXPECT_NEAR(between.u(0), cubic(0.9).u(0), 1e-14);
  EXPECT_NEAR(between.v(0), cubic(0.9).v(0), 1e-14);
  EXPECT_NEAR(between.a(0), cubic(0.9).a(0), 1e-14);
  const auto error = [](const double h) { return interpolate(sine(1), sine(1 + h), 1 + 0.4 * h, true).u(0) - std::sin(1 + 0.4 * h); };
  EXPECT_NEAR(std::log2(error(0.1) / error(0.05)), 4, 0.1);
}

TEST(DenseOutput, writesAtItsInstantsWhateverTheStepsAre)
{
  const test::Folder folder;
  Notes              notes(0.25, {folder.path});
  notes.begin(cubic(0));
  double t = 0;
  for (const double dt : {0.1, 0.15, 0.65, 0.05, 0.05})
    {
      t += dt;
      notes.accepted(cubic(t), step(t, dt));
    }
  ASSERT_EQ(notes.times, (std::vector<double>{0, 0.25, 0.5, 0.75, 1})) << "a multiple that a step ends on is written once";
  for (std::size_t i = 0; i < notes.times.size(); ++i)
    EXPECT_NEAR(notes.values[i], cubic(notes.times[i]).u(0), 1e-14);
}

TEST(DenseOutput, goesOnWhereItWasSaved)
{
  const test::Folder folder;
  Notes              first(0.25, {folder.path});
  first.begin(cubic(0));
  first.accepted(cubic(0.6), step(0.6, 0.6));
  Archive saved;
  first.save(saved);
  Notes second(0.25, {folder.path, &saved});
  second.resume(cubic(0.6), 1);
  second.accepted(cubic(1.1), step(1.1, 0.5));
  EXPECT_EQ(second.times, (std::vector<double>{0.75, 1}));
  EXPECT_NEAR(second.values[0], cubic(0.75).u(0), 1e-14);
}

TEST(DenseOutput, StartsThatAreNegativeOrLate)
{
  const test::Folder folder;
  Notes              early(0.25, {folder.path});
  early.begin(cubic(-1.1));
  early.accepted(cubic(-0.4), step(-0.4, 0.7));
  early.accepted(cubic(0.3), step(0.3, 0.7));
  EXPECT_EQ(early.times, (std::vector<double>{-1, -0.75, -0.5, -0.25, 0, 0.25}));
  Notes rounded(0.1, {folder.path}); // 3 x 0.1 is the double after 0.3
  rounded.begin(cubic(0.3));
  rounded.accepted(cubic(0.4), step(0.4, 0.1));
  EXPECT_EQ(rounded.times, (std::vector<double>{3 * 0.1, 0.4}));
  EXPECT_EQ(rounded.values[0], cubic(0.3).u(0)) << "the state of the start, not another one";
  Notes late(0.25, {folder.path}); // 4e10 instants before the first
  late.begin(cubic(1e10));
  late.accepted(cubic(1e10 + 0.6), step(1e10 + 0.6, 0.6));
  EXPECT_EQ(late.times, (std::vector<double>{1e10, 1e10 + 0.25, 1e10 + 0.5}));
}

TEST(DenseOutput, MultiplesAreMultiplesHoweverTheQuotientIsRounded)
{
  for (const double interval : {0.1, 0.07, 1e-3, 3.})
    for (double n = -50; n <= 50; ++n)
      {
        EXPECT_EQ(multiples_of(interval)(n * interval), n * interval);
        EXPECT_EQ(multiples_of(interval)(std::nextafter(n * interval, 1e300)), (n + 1) * interval);
      }
}

TEST(DenseOutput, withoutInertiaTheLineBetweenTheEnds)
{
  const State begin{1, vector(2), vector(0), vector(0)}, end{3, vector(6), vector(0), vector(0)};
  const State between = interpolate(begin, end, 1.5, false);
  EXPECT_NEAR(between.u(0), 3, 1e-14);
  EXPECT_NEAR(between.v(0), 2, 1e-14);
}

TEST(DenseOutput, afterARestartFromTheRightLimit)
{
  // at rest until 1, then u = (t - 1)^3 + 2 (t - 1): the velocity jumps by 2
  const test::Folder folder;
  Notes              notes(0.5, {folder.path});
  const auto         after = [](const double t) {
    const double s = t - 1;
    return State{t, vector(s * s * s + 2 * s), vector(3 * s * s + 2), vector(6 * s)};
  };
  notes.begin({0, vector(0), vector(0), vector(0)});
  notes.accepted({1, vector(0), vector(0), vector(0)}, step(1, 1));
  notes.restarted(after(1));
  notes.accepted(after(2), step(2, 1));
  ASSERT_EQ(notes.times, (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  EXPECT_NEAR(notes.values[3], after(1.5).u(0), 1e-14);
}

TEST(DenseOutput, askedForOnlyWhenResumedItBeginsThere)
{
  const test::Folder folder;
  const Archive      saved;
  Notes              notes(0.25, {folder.path, &saved});
  notes.resume(cubic(0.6), 1);
  notes.accepted(cubic(1.1), step(1.1, 0.5));
  EXPECT_EQ(notes.times, (std::vector<double>{0.75, 1}));
}
