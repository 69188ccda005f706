// SPDX-License-Identifier: LGPL-2.1-or-later
// Eigenvalues that limit explicit steps, against closed forms of uniform rods.

#include "rod.h"

#include <myolines/system/drive_types.h>
#include <myolines/time/stable_step.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  Rod1dParameters linear_rod(const unsigned int degree, const unsigned int n_elements)
  {
    Rod1dParameters p;
    p.degree     = degree;
    p.n_elements = n_elements;
    p.material   = RodMaterial::linear_elastic(1e6, 0.4);
    p.strain     = std::make_shared<PiecewiseDrive>(PiecewiseDrive::constant(0));
    return p;
  }

  /// Of M^-1 K at rest, times rho h^2 / E.
  double scaled_eigenvalue(const Rod1dParameters &p, const double factor = 1)
  {
    Solvers                 solvers({"relative tolerance=1e-12", "absolute tolerance=0"});
    const Rod1dSystem       system(p, solvers.ledger);
    const IntegratorContext context{system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger};
    StageSolver             solver(context);
    const State             rest = system.initial_state(0);
    StepReport              report;
    const Point             point{0, Side::right, rest.u, rest.v, rest.a};
    const double            all = largest_eigenvalues(point, context, solver, report).stiffness;
    EXPECT_TRUE(report.accepted()) << report.reason;
    EXPECT_EQ(solvers.ledger.counted("stable step estimates"), 1u);
    const double scaled = factor == 1 ? all
                                      : largest_eigenvalue(
                                            [&](const Vector &x, Vector &y) {
                                              solver.apply({1, 0, 0}, x, y);
                                              y *= factor;
                                            },
                                            system, solver, rest.u, report);
    const double h      = p.length / p.n_elements;
    return scaled * p.density * h * h / p.material.young;
  }
} // namespace

TEST(StableStep, linearElementsHaveTheirLargestEigenvalue)
{
  // 6 (1 + c)/(2 - c), c = cos(pi/n): the shortest of the waves sin(k pi x/L)
  for (const unsigned int n : {2u, 3u, 10u, 80u})
    {
      const double c = std::cos(M_PI / n), exact = 6 * (1 + c) / (2 - c);
      EXPECT_NEAR(scaled_eigenvalue(linear_rod(1, n)), exact, 1e-3 * exact) << n;
    }
}

TEST(StableStep, quadraticElementsHaveTheirLargestEigenvalue)
{
  // 60 of a single free element, 59.952 of 64 elements (errata 19)
  EXPECT_NEAR(scaled_eigenvalue(linear_rod(2, 64)), 59.952, 0.01);
}

TEST(StableStep, theLargestEigenvalueIsNoModulus)
{
  // of -K it is that of the longest wave: pi^2/n^2, to the fourth order in 1/n
  const unsigned int n = 6;
  EXPECT_NEAR(scaled_eigenvalue(linear_rod(2, n), -1), -M_PI * M_PI / (n * n), 1e-3);
}
