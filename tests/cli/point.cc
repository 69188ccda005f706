// SPDX-License-Identifier: LGPL-2.1-or-later
// The single-point driver against closed forms.
#include "../support/places.h"
#include "program_runner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{
  const std::string input = myolines::test::source_folder() + "/input/";

  /// The numbers of the row of @p file whose first entry is nearest to @p x.
  std::vector<double> row_at(const std::filesystem::path &file, const double x)
  {
    std::ifstream       stream(file);
    std::string         line;
    std::vector<double> best;
    std::getline(stream, line);
    while (std::getline(stream, line))
      {
        std::vector<double> row;
        std::istringstream  cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
          row.push_back(std::stod(cell));
        if (best.empty() || std::abs(row[0] - x) < std::abs(best[0] - x))
          best = row;
      }
    return best;
  }
} // namespace

TEST(Point, EqualsClosedForms)
{
  const TestFolder folder;
  const Outcome    outcome =
      run_program(folder, "point " + input + "force_length/gastrocnemius.xml --out p --stretch 0.5 1.5 101 --activation 0 0.5 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::filesystem::path p = folder / "p";
  // Table A.6 beyond 1.25, and 0.9941 of the active curve at rest.
  const double passive = 2e5 * (3.436357 * 0.05 * 0.05 + 1.176922 * 0.05 + 0.147115);
  EXPECT_NEAR(row_at(p / "muscle_stretch.csv", 1.3)[1], passive, 1e-6 * passive);
  const std::vector<double> rest = row_at(p / "muscle_stretch.csv", 1);
  EXPECT_NEAR(rest[3], 2e5 * 0.994100, 0.1);
  EXPECT_NEAR(rest[2], 0.5 * rest[3], 1e-6);
  EXPECT_NEAR(row_at(p / "muscle_strain_rate.csv", 1)[3], rest[3] * 1.595047, 1e-3);
  // (A.2.4) at 1.01, and twice the slope of the Yeoh law times s^2 - 1/s.
  EXPECT_NEAR(row_at(p / "aponeurosis_stretch.csv", 1.01)[1], 2e5 * 0.061688, 1e-6 * 2e5);
  const double s = 1.2, x = s * s + 2 / s - 3;
  const double expected = 2 * (s * s - 1 / s) * 2e5 * (4.6896264975 - 2 * 3.4551410975 * x + 3 * 484.92055395 * x * x);
  EXPECT_NEAR(row_at(p / "aponeurosis_base.csv", s)[1], expected, 1e-9 * expected);
  for (const char *picture : {"muscle_stretch", "muscle_strain_rate", "muscle_surface", "muscle_base", "aponeurosis_base"})
    EXPECT_TRUE(std::filesystem::exists(p / "pictures" / (std::string(picture) + ".svg"))) << picture;
}

// Thesis Figure 3.4: at stretch 1.2 Table A.1 prints 0.669106, Table A.2 the cubic from 1.12, and (3.3.9), (3.3.10) give the base material.
TEST(Point, OfOneDimensionalMusclesEqualsClosedForms)
{
  const TestFolder  folder;
  const std::string chain = input + "one_dimensional/isometric_chain.xml --stretch 0.5 1.5 101 --activation 0 0.5 1";
  const Outcome     with  = run_program(folder, "point " + chain + " --out with --set 'system/base material fraction=0.0015'");
  ASSERT_EQ(with.exit_code, 0) << with.err;
  EXPECT_NE(with.out.find("falls nowhere"), std::string::npos) << with.out;
  const double s = 1.2, nu = 0.499, mu = 1 / (2 * (1 + nu)), lambda = nu / ((1 - nu) * (1 - 2 * nu)), x = s - 1.12;
  const double active = 0.9985 * 0.669106, passive = 0.9985 * (((7.439238 * x + 1.093430) * x + 0.425952) * x + 0.061576),
               base = 0.0015 * 5 * (mu * s + (lambda * std::log(s) - mu) / s);

  const std::vector<double> parts = row_at(folder / "with/muscle_parts.csv", s);
  EXPECT_NEAR(parts[1], active, 1e-12);
  EXPECT_NEAR(parts[2], passive, 1e-12);
  EXPECT_NEAR(parts[3], base, 1e-12);
  EXPECT_NEAR(parts[4], active + passive + base, 1e-12);
  EXPECT_NEAR(row_at(folder / "with/muscle_stretch.csv", s)[2], 0.5 * active + passive + base, 1e-12);
  EXPECT_NEAR(row_at(folder / "with/muscle_strain_rate.csv", 1)[3], 0.9985 * (1.6 + 0.024066), 1e-5);
  EXPECT_TRUE(std::filesystem::exists(folder / "with/pictures/muscle_parts.svg"));

  // Without it the force falls from the optimal length, where the active curve has its maximum, to 1.33.
  const Outcome without = run_program(folder, "point " + chain + " --out without");
  ASSERT_EQ(without.exit_code, 0) << without.err;
  EXPECT_NE(without.out.find("falls at stretches from 1.01 to 1.3"), std::string::npos) << without.out;
}

TEST(Point, WhatCannotBeIsRefused)
{
  const TestFolder folder;
  EXPECT_EQ(run_program(folder, "point " + input + "oscillator.xml").exit_code, 2);
  EXPECT_EQ(run_program(folder, "point " + input + "isometric_block.xml --stretch 1 0.5 10").exit_code, 2);
  EXPECT_EQ(run_program(folder, "point " + input + "isometric_block.xml --stretch 0 1 10").exit_code, 2);
  EXPECT_EQ(run_program(folder, "point " + input + "isometric_block.xml --activation 1.5").exit_code, 2);
  const Outcome both = run_program(folder, "point " + input + "isometric_block.xml --stretch 0 0 1.5");
  for (const char *condition : {"FROM > 0", "FROM < TO", "an integer in [2, 1000000]"})
    EXPECT_NE(both.err.find(condition), std::string::npos) << both.err;
  const Outcome infinite = run_program(folder, "point " + input + "isometric_block.xml --stretch 0.5 1e308 3");
  EXPECT_EQ(infinite.exit_code, 2);
  EXPECT_NE(infinite.err.find("is not finite"), std::string::npos) << infinite.err;
  folder.write("file", "");
  EXPECT_EQ(run_program(folder, "point " + input + "isometric_block.xml --out file").exit_code, 2);
}

/// Fewer rates than curves: each once.
TEST(Point, SurfaceHasEveryRateOnce)
{
  const TestFolder folder;
  const Outcome    outcome = run_program(folder, "point " + input + "isometric_block.xml --out p --stretch 0.9 1.1 3 --strain-rate -1 1 3");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string script = contents(folder / "p/pictures/muscle_surface.gp");
  const auto        first  = script.find("'strain rate -1'");
  ASSERT_NE(first, std::string::npos) << script;
  EXPECT_EQ(script.substr(first + 1, script.find("set terminal svg") - first).find("'strain rate -1'"), std::string::npos);
}
