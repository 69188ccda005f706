// SPDX-License-Identifier: LGPL-2.1-or-later
// The implicit-explicit scheme of thesis (4.7.9), by hand; against an independent program in tests/regression/imex_rod.

#include "../support/taylor.h"
#include "rod.h"

#include <myolines/system/drive_types.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  constexpr double mu = 1e6 / 2.8, lambda = 1e6 * 0.4 / (0.6 * 0.2); // thesis (4.7.2), kappa = 1 MPa, nu = 0.4

  /// Two linear elements: one free unknown.
  Rod1dParameters small_rod()
  {
    Rod1dParameters p;
    p.degree     = 1;
    p.n_elements = 2;
    p.material   = RodMaterial::neo_hookean_thesis(1e6, 0.4);
    p.strain     = std::make_shared<PiecewiseDrive>(PiecewiseDrive::lines({{0, 0}, {0.5, 0.1}}));
    return p;
  }

  /// F_1 + mu F_2 of (4.7.6): what is left of P without mu (l - 1), (lambda log l - mu)/l + mu
  double explicit_stress(const double strain) { return (lambda * std::log(1 + strain) - mu) / (1 + strain) + mu; }
} // namespace

TEST(RodSplits, linearIsTheLinearPartOfTheStress)
{
  WorkLedger        ledger;
  const Rod1dSystem rod(small_rod(), ledger);
  const auto        part = rod.implicit_part("linear");
  ASSERT_NE(part, nullptr);
  State s = rod.initial_state(0);
  s.u(1)  = 0.004;
  s.u(2)  = 0.007;
  s.a(1)  = 30;
  // L = 0.1, h = 0.05, A = 1e-4: A mu/h (2 u_1 - u_0 - u_2) + rho A h (4 a_1)/6
  const double h = 0.05, area = 1e-4;
  EXPECT_NEAR(residual_at(*part, s)(1), area * mu / h * (2 * 0.004 - 0.007) + 1060 * area * h * 4 / 6 * 30, 1e-12);
  EXPECT_NEAR(residual_at(rod, s)(1) - residual_at(*part, s)(1), area * (explicit_stress(0.004 / h) - explicit_stress(0.003 / h)), 1e-11);
  EXPECT_TRUE(part->capabilities().linear);
  EXPECT_LT(taylor_error(*part, s, {1, 0, 1}, s.u, 1e-2), 1e-11);
  EXPECT_EQ(part->events(-1, 1), rod.events(-1, 1));
  EXPECT_EQ(rod.implicit_part("passive"), nullptr);
}

TEST(RodSplits, linearIsEverythingOfALinearRod)
{
  Rod1dParameters p  = small_rod();
  p.material         = RodMaterial::linear_elastic(1e6, 0.4);
  p.stiffness_factor = 2;
  WorkLedger        ledger;
  const Rod1dSystem rod(p, ledger);
  State             s = rod.initial_state(0);
  s.u(1)              = 0.004;
  s.a(1)              = 30;
  Vector difference   = residual_at(rod, s);
  difference -= residual_at(*rod.implicit_part("linear"), s);
  EXPECT_EQ(difference.l2_norm(), 0);
}

TEST(ImexRod, stepsAsTheThesisSays)
{
  // (4.7.9) of the free unknown, with prescribed u_2 and v_2 = (u_2 - u_2 before)/dt: M = rho A h/6 (4 1), K = A mu/h (2 -1)
  Rod          rod(small_rod(), "imex euler", {"split=linear"});
  const double dt = 1e-4, h = 0.05, rho = 1060;
  double       u = 0, v = 0, end = 0, v_end = 0;
  rod.integrator->start(rod.state);
  for (unsigned int n = 1; n <= 50; ++n)
    {
      const double end_1 = 0.1 * 0.2 * n * dt, v_end_1 = (end_1 - end) / dt;
      const double force = explicit_stress(u / h) - explicit_stress((end - u) / h);
      // rho h/6 (4 (v_1 - v)/dt + (v_end_1 - v_end)/dt) + mu/h (2 (u + dt v_1) - end_1) + force = 0
      v = (rho * h / 6 * (4 * v - (v_end_1 - v_end)) / dt - mu / h * (2 * u - end_1) - force) / (rho * h / 6 * 4 / dt + 2 * mu / h * dt);
      u += dt * v;
      end   = end_1;
      v_end = v_end_1;
      ASSERT_TRUE(rod.integrator->step(dt, rod.state).accepted());
      ASSERT_NEAR(rod.state.u(1), u, 1e-14 + 1e-11 * std::abs(u));
      ASSERT_NEAR(rod.state.v(1), v, 1e-11 * std::max(1., std::abs(v)));
    }
  EXPECT_GT(u, 4e-5) << "the rod has moved";
}

TEST(ImexRod, aFailedStepNamesTheLimitOfTheExplicitPart)
{
  // 2/sqrt(12 (F_1' - mu)/(rho h^2)) were the rod long; with one free unknown 2 h/sqrt(3 (F_1' - mu)/rho), F_1' - mu = lambda
  Rod rod(small_rod(), "imex euler", {"split=linear"});
  rod.integrator->start(rod.state);
  const double       limit = 2 * 0.05 / std::sqrt(3 * lambda / 1060);
  StepReport         report;
  std::ostringstream number;
  number.precision(4);
  number << limit;
  for (unsigned int n = 0; n < 2000 && report.accepted(); ++n)
    report = rod.integrator->step(1.05 * limit, rod.state);
  EXPECT_EQ(report.outcome, StepReport::Outcome::inadmissible);
  EXPECT_NE(report.reason.find("the explicit part of the split \"linear\" limits the step to about " + number.str() + " s"),
            std::string::npos)
      << report.reason;
  EXPECT_EQ(rod.solvers.ledger.counted("stable step estimates"), 1u);
}
