// SPDX-License-Identifier: LGPL-2.1-or-later
// A run that is asked to stop: solves fail at the next occasion, and say so.

#include "small_problem.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  /// The solvers of a run that is asked to stop when it has been asked @p after times.
  struct Stopped
  {
    explicit Stopped(const unsigned int after)
      : linear(node(LinearSolver::linear_schema()), node(LinearSolver::preconditioner_schema(), {"type=jacobi"}), ledger,
               [this, after] { return ++asked > after; })
      , nonlinear(node(NonlinearSolver::schema()), linear, ledger)
    {}

    unsigned int    asked = 0;
    WorkLedger      ledger;
    LinearSolver    linear;
    NonlinearSolver nonlinear;
  };

  /// x^3 = 8 in forty unknowns, coupled to their neighbours.
  SmallProblem cubic()
  {
    constexpr unsigned int n = 40;
    SmallProblem           problem(n);
    problem.f = [](const Values &x) {
      Values f(x.size());
      for (std::size_t i = 0; i < x.size(); ++i)
        f[i] = x[i] * x[i] * x[i] - 8 + (i > 0 ? x[i] - x[i - 1] : 0.);
      return f;
    };
    problem.jacobian = [](const Values &x) {
      std::vector<Values> J(x.size(), Values(x.size(), 0.));
      for (std::size_t i = 0; i < x.size(); ++i)
        {
          J[i][i] = 3 * x[i] * x[i] + (i > 0 ? 1. : 0.);
          if (i > 0)
            J[i][i - 1] = -1;
        }
      return J;
    };
    return problem;
  }

  NonlinearReport solve(Stopped &run)
  {
    SmallProblem problem = cubic();
    Values       guess(40, 1.);
    for (std::size_t i = 0; i < guess.size(); ++i)
      guess[i] += 0.1 * std::sin(i);
    Vector x = problem.start(guess);
    return run.nonlinear.solve(problem, x);
  }
} // namespace

TEST(StopRequest, aSolveGoesOnWhileNobodyAsks)
{
  Stopped               run(1000000);
  const NonlinearReport report = solve(run);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_GT(run.asked, report.iterations + report.linear_iterations) << "asked in every iteration of both kinds";
}

TEST(StopRequest, newtonsMethodEndsWhereverItIs)
{
  Stopped            whole(1000000);
  const unsigned int asked = (solve(whole), whole.asked);
  for (unsigned int after = 0; after + 1 < asked; after += 3)
    {
      Stopped               run(after);
      const NonlinearReport report = solve(run);
      EXPECT_FALSE(report.converged) << after;
      EXPECT_NE(report.reason.find("asked to stop"), std::string::npos) << report.reason;
      EXPECT_LE(run.asked, after + 8) << "it does not try again";
    }
}
