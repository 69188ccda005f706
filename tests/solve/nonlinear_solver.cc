// SPDX-License-Identifier: LGPL-2.1-or-later
#include "small_problem.h"

#include <myolines/base/error.h>

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  SmallProblem scalar(const std::function<double(double)> &f, const std::function<double(double)> &slope)
  {
    SmallProblem problem(1);
    problem.f        = [f](const Values &x) { return Values{f(x[0])}; };
    problem.jacobian = [slope](const Values &x) { return std::vector<Values>{{slope(x[0])}}; };
    return problem;
  }

  /// x0^2 + x1^2 = 4, x0 x1 = 1: a root at x0 = sqrt(2 + sqrt 3).
  void set_circle(SmallProblem &problem)
  {
    problem.f        = [](const Values &x) { return Values{x[0] * x[0] + x[1] * x[1] - 4, x[0] * x[1] - 1}; };
    problem.jacobian = [](const Values &x) { return std::vector<Values>{{2 * x[0], 2 * x[1]}, {x[1], x[0]}}; };
  }

  /// x + D ((x - 1) / h + w) - 2 with a damper D, evaluated at the first guess at a rate that is off by w.
  class Damped : public SmallProblem
  {
  public:
    double gap = 0;
    double at  = 0; ///< share of the gap that is open

    Damped(const std::function<double(double)> &damper, const std::function<double(double)> &slope, const double h)
      : SmallProblem(1)
      , slope_(slope)
      , h_(h)
    {
      f        = [=](const Values &x) { return Values{x[0] + damper((x[0] - 1) / h + at * gap) - 2}; };
      jacobian = [=](const Values &x) {
        slope_here_ = slope((x[0] - 1) / h + at * gap);
        return std::vector<Values>{{1 + slope_here_ / h}};
      };
    }

    bool open_rates(const Vector &) override
    {
      at = gap == 0 ? 0 : 1;
      return gap != 0;
    }
    void keep_open(const double share) override { at = share; }
    void lift_rates(Vector &y) override
    {
      gap *= at;
      at = 1;
      y(0) -= slope_here_ * gap;
    }

  private:
    std::function<double(double)> slope_;
    double                        h_;
    double                        slope_here_ = 0;
  };

  const Overrides tight = {"relative tolerance=1e-14", "absolute tolerance=1e-14"};
} // namespace

TEST(NonlinearSolver, convergesQuadratically)
{
  Solvers      solvers(tight, {}, {"type=direct", "rebuild=every step", "slow iterations=1"});
  SmallProblem problem(2);
  set_circle(problem);
  Vector                x      = problem.start({2.5, 0.2});
  const NonlinearReport report = solvers.nonlinear.solve(problem, x);
  ASSERT_TRUE(report.converged) << report.reason;
  EXPECT_NEAR(x(0), std::sqrt(2 + std::sqrt(3.)), 1e-14);
  EXPECT_NEAR(x(1), 1 / std::sqrt(2 + std::sqrt(3.)), 1e-14);
  EXPECT_LE(report.iterations, 7u);
  EXPECT_EQ(report.residual_evaluations, problem.norms.size());
  EXPECT_EQ(solvers.ledger.counted("newton iterations"), report.iterations);
  EXPECT_EQ(solvers.ledger.counted("linear solves"), report.iterations);
  EXPECT_DOUBLE_EQ(report.initial_residual, problem.norms.front());
}

TEST(NonlinearSolver, halvesTheErrorExponentEachStep)
{
  // A fresh exact Jacobian: |f_(k+1)| / |f_k|^2 stays bounded down to round-off, which no linearly convergent iteration does.
  // The last solve goes to half the tolerance.
  Solvers      solvers({"relative tolerance=1e-15", "absolute tolerance=1e-14", "forcing maximum=1e-12", "forcing minimum=1e-13"}, {},
                       {"type=direct"});
  SmallProblem problem(2);
  set_circle(problem);
  Vector x = problem.start({2.5, 0.2});
  ASSERT_TRUE(solvers.nonlinear.solve(problem, x).converged);
  for (std::size_t k = 0; k + 1 < problem.norms.size(); ++k)
    EXPECT_LT(problem.norms[k + 1], 0.5 * problem.norms[k] * problem.norms[k] + 1e-14) << "step " << k;
}

TEST(NonlinearSolver, lineSearchRescuesAnOvershootingStep)
{
  const auto f     = [](double x) { return std::atan(x); };
  const auto slope = [](double x) { return 1 / (1 + x * x); };
  {
    Solvers      solvers(tight);
    SmallProblem problem = scalar(f, slope);
    Vector       x       = problem.start({10});
    EXPECT_TRUE(solvers.nonlinear.solve(problem, x).converged);
    EXPECT_NEAR(x(0), 0, 1e-13);
    EXPECT_GE(solvers.ledger.counted("line search cuts"), 1u);
  }
  {
    Solvers               solvers({"line search cuts=0"});
    SmallProblem          problem = scalar(f, slope);
    Vector                x       = problem.start({10});
    const NonlinearReport report  = solvers.nonlinear.solve(problem, x);
    EXPECT_FALSE(report.converged);
    EXPECT_FALSE(report.inadmissible);
    EXPECT_NE(report.reason.find("line search"), std::string::npos) << report.reason;
  }
}

TEST(NonlinearSolver, shortensStepsThatLeaveTheDomain)
{
  const auto f     = [](double x) { return x > 0 ? std::log(x) : std::numeric_limits<double>::quiet_NaN(); };
  const auto slope = [](double x) { return 1 / x; };
  {
    Solvers      solvers(tight);
    SmallProblem problem = scalar(f, slope);
    Vector       x       = problem.start({5});
    EXPECT_TRUE(solvers.nonlinear.solve(problem, x).converged);
    EXPECT_NEAR(x(0), 1, 1e-13);
  }
  {
    Solvers               solvers({"line search cuts=0"});
    SmallProblem          problem = scalar(f, slope);
    Vector                x       = problem.start({5});
    const NonlinearReport report  = solvers.nonlinear.solve(problem, x);
    EXPECT_FALSE(report.converged);
    EXPECT_TRUE(report.inadmissible);
    EXPECT_NE(report.reason.find("outside of the domain"), std::string::npos) << report.reason;
  }
  {
    Solvers               solvers;
    SmallProblem          problem = scalar(f, slope);
    Vector                x       = problem.start({-1});
    const NonlinearReport report  = solvers.nonlinear.solve(problem, x);
    EXPECT_FALSE(report.converged);
    EXPECT_TRUE(report.inadmissible);
    EXPECT_EQ(report.iterations, 0u);
  }
}

TEST(NonlinearSolver, liftsPrescribedUnknowns)
{
  // A linear spring of stiffness 3 between unknowns 0 and 1, one of stiffness 1 from 0 to the ground; unknown 1 is moved.
  Solvers      solvers;
  SmallProblem problem(2);
  problem.f        = [](const Values &x) { return Values{3 * (x[0] - x[1]) + x[0], 3 * (x[1] - x[0])}; };
  problem.jacobian = [](const Values &) { return std::vector<Values>{{4, -3}, {-3, 3}}; };
  problem.targets  = {{1, 0.7}};
  problem.relations.add_line(1);
  problem.relations.close();
  Vector                x      = problem.start({0, 0});
  const NonlinearReport report = solvers.nonlinear.solve(problem, x);
  ASSERT_TRUE(report.converged) << report.reason;
  EXPECT_EQ(x(1), 0.7);
  EXPECT_NEAR(x(0), 0.75 * 0.7, 1e-15);
  EXPECT_EQ(report.iterations, 1u);
  EXPECT_EQ(report.residual_evaluations, 2u);
  EXPECT_NEAR(report.initial_residual, 3 * 0.7, 1e-15);
}

TEST(NonlinearSolver, reappliesTheLiftThatADampedStepLeft)
{
  // The spring between 0 and 1 stiffens without bound at a stretch of 0.25: the full lift of 0.8 is inadmissible at first.
  const auto   force = [](double s) { return std::abs(s) < 0.25 ? s / (0.0625 - s * s) : std::numeric_limits<double>::quiet_NaN(); };
  const auto   slope = [](double s) { return (0.0625 + s * s) / ((0.0625 - s * s) * (0.0625 - s * s)); };
  Solvers      solvers(tight);
  SmallProblem problem(2);
  problem.f        = [=](const Values &x) { return Values{force(x[0] - x[1]) + 40 * x[0], force(x[1] - x[0])}; };
  problem.jacobian = [=](const Values &x) {
    const double k = slope(x[0] - x[1]);
    return std::vector<Values>{{k + 40, -k}, {-k, k}};
  };
  problem.targets = {{1, 0.8}};
  problem.relations.add_line(1);
  problem.relations.close();
  Vector                x      = problem.start({0, 0});
  const NonlinearReport report = solvers.nonlinear.solve(problem, x);
  ASSERT_TRUE(report.converged) << report.reason;
  EXPECT_EQ(x(1), 0.8);
  EXPECT_NEAR(force(x(0) - 0.8) + 40 * x(0), 0, 1e-11);
  EXPECT_GE(solvers.ledger.counted("line search cuts"), 1u);
}

TEST(NonlinearSolver, condensesRelationsBetweenUnknowns)
{
  // Unknown 2 = (x0 + x1)/2 + 0.1 and a cubic energy in all three: compare with the condensed problem in two unknowns,
  // solved by its optimality conditions.
  const auto   energy_slope = [](double x, double a) { return x * x * x + x - a; };
  Solvers      solvers(tight);
  SmallProblem problem(3);
  problem.f        = [=](const Values &x) { return Values{energy_slope(x[0], 1), energy_slope(x[1], -2), energy_slope(x[2], 3)}; };
  problem.jacobian = [](const Values &x) {
    return std::vector<Values>{{3 * x[0] * x[0] + 1, 0, 0}, {0, 3 * x[1] * x[1] + 1, 0}, {0, 0, 3 * x[2] * x[2] + 1}};
  };
  problem.targets = {{2, 0.1}};
  problem.relations.add_line(2);
  problem.relations.add_entry(2, 0, 0.5);
  problem.relations.add_entry(2, 1, 0.5);
  problem.relations.close();
  Vector                x      = problem.start({0, 0, 0});
  const NonlinearReport report = solvers.nonlinear.solve(problem, x);
  ASSERT_TRUE(report.converged) << report.reason;
  EXPECT_NEAR(x(2), 0.5 * (x(0) + x(1)) + 0.1, 1e-15);
  EXPECT_NEAR(energy_slope(x(0), 1) + 0.5 * energy_slope(x(2), 3), 0, 1e-12);
  EXPECT_NEAR(energy_slope(x(1), -2) + 0.5 * energy_slope(x(2), 3), 0, 1e-12);
}

TEST(NonlinearSolver, doesNothingAtARoot)
{
  Solvers               solvers;
  SmallProblem          problem = scalar([](double x) { return x * x - 4; }, [](double x) { return 2 * x; });
  Vector                x       = problem.start({2});
  const NonlinearReport report  = solvers.nonlinear.solve(problem, x);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0u);
  EXPECT_EQ(x(0), 2);
  EXPECT_EQ(solvers.ledger.counted("linear solves"), 0u);
}

TEST(NonlinearSolver, reportsInsteadOfThrowing)
{
  {
    Solvers               solvers;
    SmallProblem          problem = scalar([](double x) { return x * x + 1; }, [](double x) { return 2 * x; });
    Vector                x       = problem.start({0}); // zero slope: singular
    const NonlinearReport report  = solvers.nonlinear.solve(problem, x);
    EXPECT_FALSE(report.converged);
    EXPECT_NE(report.reason.find("linear solver"), std::string::npos) << report.reason;
  }
  {
    Solvers               solvers({"maximum iterations=2"});
    SmallProblem          problem = scalar([](double x) { return std::exp(x) - 1; }, [](double x) { return std::exp(x); });
    Vector                x       = problem.start({10});
    const NonlinearReport report  = solvers.nonlinear.solve(problem, x);
    EXPECT_FALSE(report.converged);
    EXPECT_EQ(report.iterations, 2u);
    EXPECT_NE(report.reason.find("2 Newton iterations"), std::string::npos) << report.reason;
    EXPECT_GT(report.final_residual, 0);
  }
  {
    Solvers      solvers;
    SmallProblem problem = scalar([](double) -> double { throw std::runtime_error("no such state"); }, [](double) { return 1.; });
    Vector       x       = problem.start({1});
    EXPECT_EQ(solvers.nonlinear.solve(problem, x).reason, "no such state");
  }
}

namespace
{
  /// Of one equation whose forces and rounding are told.
  class Sized : public SmallProblem
  {
  public:
    Sized(std::function<double(double)> f_of_x, std::function<double(double)> slope, const double rounding)
      : SmallProblem(1)
      , rounding_(rounding)
    {
      f        = [f_of_x](const Values &x) { return Values{f_of_x(x[0])}; };
      jacobian = [slope](const Values &x) { return std::vector<Values>{{slope(x[0])}}; };
    }
    Evaluation residual(const Vector &x, Vector &r) override
    {
      Evaluation evaluation = SmallProblem::residual(x, r);
      evaluation.forces     = 1;
      evaluation.rounding   = rounding_;
      return evaluation;
    }

  private:
    const double rounding_;
  };

  NonlinearReport failure(SmallProblem &problem, const double start, const Overrides &settings = {})
  {
    Solvers               solvers(settings);
    Vector                x      = problem.start({start});
    const NonlinearReport report = solvers.nonlinear.solve(problem, x);
    EXPECT_FALSE(report.converged);
    return report;
  }

  bool tells(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }
} // namespace

// Advice fits the cause, and leaves out what cannot help.
TEST(NonlinearSolver, advisesByCause)
{
  const auto line = [](double x) { return x; };
  const auto one  = [](double) { return 1.; };

  Sized                 noise([](double x) { return x + (x > 0 ? 1e-9 : -1e-9); }, one, 1e-11); // jumps over its root
  const NonlinearReport rounding = failure(noise, 1, {"relative tolerance=1e-12"});
  EXPECT_TRUE(tells(rounding.advice, "relative tolerance")) << rounding.advice;
  EXPECT_FALSE(rounding.shorter_steps);

  Sized                 well([](double x) { return 1 + std::abs(x); }, [](double x) { return x > 0 ? 1. : -1.; }, 1e-16);
  const NonlinearReport indefinite = failure(well, 0);
  EXPECT_TRUE(tells(indefinite.reason, "the tangent is indefinite")) << indefinite.reason;
  EXPECT_EQ(indefinite.advice, "");
  EXPECT_TRUE(indefinite.shorter_steps);

  Sized                 slow([](double x) { return x * x * x; }, [](double x) { return 3 * x * x; }, 1e-16);
  const NonlinearReport iterations = failure(slow, 1, {"maximum iterations=3"});
  EXPECT_TRUE(tells(iterations.advice, "maximum iterations")) << iterations.advice;
  EXPECT_TRUE(iterations.shorter_steps);

  Sized                 edge([](double x) { return x > 0 ? std::nan("") : 1.; }, [](double) { return -1.; }, 1e-16);
  const NonlinearReport inadmissible = failure(edge, 0);
  EXPECT_TRUE(tells(inadmissible.reason, "inadmissible")) << inadmissible.reason;
  EXPECT_FALSE(tells(inadmissible.advice, "tolerance")) << inadmissible.advice;

  Sized given(line, one, 1e-16);
  given.relations.add_line(0);
  given.relations.close();
  given.targets[0]                = std::nan("");
  const NonlinearReport undefined = failure(given, 1);
  EXPECT_TRUE(tells(undefined.advice, "defined at all times")) << undefined.advice;
  EXPECT_FALSE(undefined.shorter_steps);
}

TEST(NonlinearSolver, refusesContradictingTolerances)
{
  EXPECT_THROW(Solvers({"forcing minimum=0.1", "forcing maximum=0.01"}), InputError);
  EXPECT_THROW(Solvers({"relative tolerance=2"}), InputError);
  EXPECT_THROW(Solvers({"relative toleranse=1e-3"}), InputError);
}

TEST(NonlinearSolver, closesAGapOfTheRates)
{
  // An affine problem: one step, wherever the rate began.
  for (const double gap : {0., -7.})
    {
      Solvers solvers(tight);
      Damped  problem([](double r) { return 3 * r; }, [](double) { return 3.; }, 0.5);
      problem.gap                  = gap;
      Vector                x      = problem.start({5});
      const NonlinearReport report = solvers.nonlinear.solve(problem, x);
      ASSERT_TRUE(report.converged) << report.reason;
      EXPECT_EQ(report.iterations, 1u);
      EXPECT_NEAR(x(0), 8. / 7, 1e-14); // x + 6 (x - 1) = 2
      EXPECT_EQ(problem.at, 0);
    }

  // A damper that saturates: the rate of the guess, -10, tells Newton's method nothing of the slope at the root, a rate of -0.1 does.
  // Damped steps, which leave a part of the gap, end at the same root.
  const auto   damper = [](double r) { return 20 * std::tanh(r); };
  const auto   slope  = [](double r) { return 20 / (std::cosh(r) * std::cosh(r)); };
  const double root   = [&] {
    double low = 0, high = 2;
    while (high - low > 1e-16 * high && 0.5 * (low + high) != low && 0.5 * (low + high) != high)
      (0.5 * (low + high) + damper((0.5 * (low + high) - 1) / 0.1) > 2 ? high : low) = 0.5 * (low + high);
    return low;
  }();
  std::map<double, unsigned int> iterations;
  for (const double gap : {0., 9.9, 11., 14.})
    {
      Solvers solvers(tight);
      Damped  problem(damper, slope, 0.1);
      problem.gap                  = gap;
      Vector                x      = problem.start({0});
      const NonlinearReport report = solvers.nonlinear.solve(problem, x);
      ASSERT_TRUE(report.converged) << report.reason << ", gap " << gap;
      EXPECT_NEAR(x(0), root, 1e-14);
      EXPECT_EQ(problem.at, 0);
      iterations[gap] = report.iterations;
    }
  EXPECT_LT(iterations[9.9], iterations[0]);
  EXPECT_LE(iterations[9.9], 6u);
}
