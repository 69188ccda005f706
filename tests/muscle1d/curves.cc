// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/table.h"

#include <myolines/muscle1d/gait.h>
#include <myolines/muscle1d/hill_force.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;

namespace
{
  hill::Curve evaluate(const std::string &name, const double x)
  {
    return name == "FA" ? hill::active(x) : name == "FP" ? hill::passive(x) : name == "FV" ? hill::force_velocity(x) : hill::tendon(x);
  }
} // namespace

// The numbers of curves_1d_eval.csv were computed from Tables A.1 to A.4 by an independent program.
TEST(HillCurves, equalTheTablesOfTheThesis)
{
  const auto rows = myolines::testing::rows("curves_1d_eval.csv");
  ASSERT_GT(rows.size(), 80u);
  for (const auto &row : rows)
    {
      const double      x          = std::stod(row[1]);
      const hill::Curve curve      = evaluate(row[0], x);
      const bool        below_rest = row[0] == "FV" && x >= -0.05 && x < 0; // the printed curve jumps by 4.7e-7 at rest, ours does not
      EXPECT_NEAR(curve.value, std::stod(row[2]), below_rest ? 4.7e-7 : 6e-13) << row[0] << "(" << x << ")";
      EXPECT_NEAR(curve.slope, std::stod(row[3]), 6e-11) << row[0] << "'(" << x << ")";
    }
}

TEST(HillCurves, forceVelocityIsContinuousAtRest)
{
  EXPECT_NEAR(hill::force_velocity(-1e-15).value, 1, 2e-14);
  EXPECT_EQ(hill::force_velocity(0).value, 1);
}

TEST(HillCurves, slopesAreDerivatives)
{
  for (const std::string name : {"FA", "FP", "FV", "FT"})
    for (double x = name == "FV" ? -1.19371 : 0.31317; x < (name == "FT" ? 1.09 : 1.8); x += 0.00971)
      {
        const double h = 1e-6, slope = evaluate(name, x).slope;
        EXPECT_NEAR((evaluate(name, x + h).value - evaluate(name, x - h).value) / (2 * h), slope, 1e-6 * (1 + std::abs(slope)))
            << name << " at " << x;
      }
}

TEST(HillForce, derivativesAreThoseOfTheForce)
{
  HillForce force;
  force.damping             = 0.01;
  force.maximum_strain_rate = 7;
  force.base                = BaseMaterial::as_printed(0.01, 5, 0.499);
  for (const double stretch : {0.823, 1.123, 1.51})
    for (const double rate : {-2.2, -0.03, 0.2, 3.})
      {
        const double           a = 0.6, h = 1e-6;
        const HillForce::Value f = force(stretch, rate, a);
        EXPECT_NEAR((force(stretch + h, rate, a).force - force(stretch - h, rate, a).force) / (2 * h), f.by_stretch, 1e-6);
        EXPECT_NEAR((force(stretch, rate + h, a).force - force(stretch, rate - h, a).force) / (2 * h), f.by_rate, 1e-6);
        EXPECT_NEAR((force(stretch, rate, a + h).force - force(stretch, rate, a - h).force) / (2 * h), f.by_activation, 1e-6);
      }
}

// Errata 11: between these stretches more length means less force.
TEST(HillForce, dipsBetweenThePrintedStretches)
{
  const HillForce force;
  for (const double end : {1.003828, 1.324975})
    EXPECT_NEAR(force.isometric(end, 1).slope, 0, 2e-5);
  EXPECT_LT(force.isometric(1.0039, 1).slope, 0);
  EXPECT_LT(force.isometric(1.3249, 1).slope, 0);
  EXPECT_GT(force.isometric(1.0037, 1).slope, 0);
  EXPECT_GT(force.isometric(1.3251, 1).slope, 0);
}

// Errata 12: the smallest slope with chi_BM = 0.0015 is 0.905, with the printed form only.
TEST(BaseMaterial, makesTheForceRiseInThePrintedForm)
{
  const auto smallest = [](const BaseMaterial &base) {
    HillForce force;
    force.base      = base;
    double smallest = 1e9;
    for (double stretch = 1; stretch < 1.6; stretch += 1e-4)
      smallest = std::min(smallest, force.isometric(stretch, 1).slope);
    return smallest;
  };
  EXPECT_NEAR(smallest(BaseMaterial::as_printed(0.0015, 5, 0.499)), 0.905, 1e-3);
  EXPECT_LT(smallest(BaseMaterial::corrected(0.0015, 5, 0.499)), 0);
  EXPECT_NEAR(BaseMaterial::corrected(0.1, 5, 0.3).force(1).slope, 5 * 3 * (1 - 0.3) / (1 + 0.3), 1e-13) << "lambda + 2 mu at rest";
}

TEST(Gait, derivativesAreThoseOfItsValues)
{
  const GaitLength     length(0.4, 0.9, 4, 1.4);
  const GaitExcitation excitation(1.4);
  for (const Drive *drive : {static_cast<const Drive *>(&length), static_cast<const Drive *>(&excitation)})
    for (double t = 0.013; t < 0.8; t += 0.0371)
      {
        const double h = 1e-5;
        EXPECT_NEAR((drive->value(t + h) - drive->value(t - h)) / (2 * h), drive->first_derivative(t), 2e-6);
        EXPECT_NEAR((drive->first_derivative(t + h) - drive->first_derivative(t - h)) / (2 * h), drive->second_derivative(t), 5e-4);
      }
}
