// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/study/csv_table.h>
#include <myolines/study/measures.h>

#include "../cli/program_runner.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines::study;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  /// @p n equal intervals of [0, end].
  template <typename Function>
  Series sampled(const Function &f, const double end, const int n)
  {
    Series series;
    for (int i = 0; i <= n; ++i)
      {
        series.t.push_back(end * i / n);
        series.x.push_back(f(series.t.back()));
      }
    return series;
  }

  double value(const std::string &name, const Series &series, const std::vector<double> *reference = nullptr,
               const MeasureOptions &options = {})
  {
    return measure(name, series, reference, options).value.value();
  }
} // namespace

TEST(Measures, FormulasOfColumnsGoRowByRow)
{
  const CsvTable table{"f.csv", {"Time [s]", "all [N]", "passive [N]"}, {{"0", "3", "1"}, {"0.5", "8", "2"}, {"1", "", "2"}}, {}};
  const Series   active = series_of_formula(table, "total - passive + 10*t", {{"total", "all [N]"}, {"passive", "passive [N]"}});
  EXPECT_EQ(active.t, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(active.x[0], 2);
  EXPECT_EQ(active.x[1], 11);
  EXPECT_TRUE(std::isnan(active.x[2])); // an empty cell is no number
  EXPECT_THROW(series_of_formula(table, "total -", {{"total", "all [N]"}}), std::invalid_argument);
}

TEST(Measures, OfASineAreItsClosedForms)
{
  const Series sine = sampled([](const double t) { return 3 * std::sin(2 * pi * t); }, 1, 1000);
  EXPECT_NEAR(value("final", sine), 0, 1e-12);
  EXPECT_DOUBLE_EQ(value("maximum", sine), 3);
  EXPECT_DOUBLE_EQ(value("minimum", sine), -3);
  EXPECT_NEAR(value("total variation", sine), 12, 1e-12); // up 3, down 6, up 3
}

/// exp(-t) cos(20 t) swings around zero and ends there: the last crossing of 5 % of the peak is at t = ln 20 up to half a swing.
TEST(Measures, DecayTimeIsThatOfTheEnvelope)
{
  const Series damped = sampled([](const double t) { return std::exp(-t) * std::cos(20 * t); }, 12, 24000);
  EXPECT_NEAR(value("decay time", damped), std::log(20.), pi / 20);
  MeasureOptions tenth;
  tenth.fraction = 0.1;
  EXPECT_NEAR(value("decay time", damped, nullptr, tenth), std::log(10.), pi / 20);
}

/// e^(at) over [0, 1]: the largest of the last quarter over that of the first is e^(a 3/4).
TEST(Measures, GrowthOfAnExponential)
{
  for (const double a : {2., 0.5})
    EXPECT_NEAR(value("growth", sampled([a](const double t) { return std::exp(a * t); }, 1, 1000)), std::exp(0.75 * a), 1e-12);
  EXPECT_FALSE(measure("growth", sampled([](double) { return 0.; }, 1, 10), nullptr, {}).value.has_value());
}

TEST(Measures, ErrorsOfAShiftedLine)
{
  const Series              x = sampled([](const double t) { return 2 * t + 0.5 * t; }, 1, 4);
  const std::vector<double> r = sampled([](const double t) { return 2 * t; }, 1, 4).x;
  EXPECT_DOUBLE_EQ(value("final error", x, &r), 0.5);
  EXPECT_DOUBLE_EQ(value("maximum error", x, &r), 0.5);
  // trapezoidal rule for (t/2)^2 with four intervals: (0/2 + 1/64 + 4/64 + 9/64 + 16/128) / 4
  EXPECT_DOUBLE_EQ(value("root mean square error", x, &r), std::sqrt((14. / 64 + 16. / 128) / 4));
  EXPECT_DOUBLE_EQ(value("final error", x, &r, {true, 0.05}), 0.25);
}

TEST(Measures, OvershootAndVariationBesideAReference)
{
  const std::vector<double> r{0, 1, 2, 2};
  EXPECT_DOUBLE_EQ(value("overshoot", {{0, 1, 2, 3}, {0, 1, 2.5, 2}}, &r), 0.25);
  EXPECT_DOUBLE_EQ(value("overshoot", {{0, 1, 2, 3}, {-1, 1, 2.5, 2}}, &r), 0.5); // below counts too
  EXPECT_DOUBLE_EQ(value("overshoot", {{0, 1, 2, 3}, {0, 1, 1.5, 1.9}}, &r), 0);
  EXPECT_DOUBLE_EQ(value("late overshoot", {{0, 1, 2, 3}, {-9, 9, 1, 2.25}}, &r), 0.125); // of the last value alone
  EXPECT_DOUBLE_EQ(value("relative variation", {{0, 1, 2, 3}, {0, 1, 0, 3}}, &r), 2.5);
}

TEST(Measures, WhatCannotBeMeasuredSaysWhy)
{
  const std::vector<double> constant{1, 1};
  EXPECT_EQ(measure("overshoot", {{0, 1}, {0, 2}}, &constant, {}).note, "the reference is constant");
  EXPECT_EQ(measure("final", {{}, {}}, nullptr, {}).note, "there is no row");
  EXPECT_EQ(measure("final", {{0, 1}, {0, std::nan("")}}, nullptr, {}).note, "the column is not finite");
  EXPECT_THROW(measure("final error", {{0, 1}, {0, 1}}, nullptr, {}), std::logic_error);
}

TEST(Measures, ReferenceIsInterpolatedAndNeverExtrapolated)
{
  const Series reference{{0, 0.1, 0.3}, {0, 1, 5}};
  const auto   values = reference_at(reference, {0, 0.05, 0.1, 0.2, 0.30000000000000004});
  ASSERT_TRUE(values.has_value());
  EXPECT_DOUBLE_EQ((*values)[1], 0.5);
  EXPECT_EQ((*values)[2], 1);
  EXPECT_NEAR((*values)[3], 3, 1e-14);
  EXPECT_EQ((*values)[4], 5); // the end, up to rounding
  EXPECT_FALSE(reference_at(reference, {0.2, 0.31}).has_value());
}

TEST(Measures, WindowKeepsItsEnds)
{
  const Series part = window({{0, 1, 2, 3}, {5, 6, 7, 8}}, 1, 2);
  EXPECT_EQ(part.t, (std::vector<double>{1, 2}));
  EXPECT_EQ(part.x, (std::vector<double>{6, 7}));
}

TEST(CsvTable, ReadsQuotesAndLeavesOutAnUnfinishedLine)
{
  const TestFolder folder;
  const auto       table = read_csv(folder.write("a.csv", "Time [s],\"force, \"\"x\"\" [N]\"\n0,1e-3\n1,inf\n2,3"));
  ASSERT_TRUE(table.has_value());
  EXPECT_EQ(table->header[1], "force, \"x\" [N]");
  ASSERT_EQ(table->rows.size(), 2u);
  const Series series = series_of(*table, "force, \"x\" [N]");
  EXPECT_EQ(series.x[0], 1e-3);
  EXPECT_TRUE(std::isnan(series.x[1]));
  EXPECT_FALSE(read_csv(folder.write("b.csv", "a,b\n1\n")).has_value());
  EXPECT_FALSE(read_csv(folder / "none.csv").has_value());
}
