#include "../support/matrices.h"
#include "../support/solvers.h"

#include <myolines/base/error.h>

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  using Values = std::vector<double>;

  /// A small problem from plain functions of plain numbers; inadmissible where f returns NaN.
  class SmallProblem : public NonlinearProblem
  {
  public:
    std::function<Values(const Values &)>              f;
    std::function<std::vector<Values>(const Values &)> jacobian;
    std::map<unsigned int, double>                     targets; ///< g of constrained unknowns
    Constraints                                        relations;
    std::vector<double>                                norms; ///< |f| of every evaluation

    explicit SmallProblem(const unsigned int size)
      : size_(size)
      , matrix_(
            size, [](unsigned int, unsigned int) { return 0.; }, relations, size)
    {}

    const Constraints &constraints() const override { return relations; }

    void impose(Vector &x) const override
    {
      for (const auto &[row, value] : targets)
        {
          x(row) = value;
          for (const auto &[index, weight] : *relations.get_constraint_entries(row))
            x(row) += weight * x(index);
        }
    }

    Evaluation residual(const Vector &x, Vector &r) override
    {
      const Values values = f(Values(x.begin(), x.end()));
      std::copy(values.begin(), values.end(), r.begin());
      norms.push_back(std::sqrt(std::inner_product(r.begin(), r.end(), r.begin(), 0.))); // r may be NaN, which l2_norm() asserts against
      return std::isfinite(norms.back()) ? Evaluation{} : Evaluation{false, "outside of the domain"};
    }

    void linearise(const Vector &x) override
    {
      const auto entries = jacobian(Values(x.begin(), x.end()));
      matrix_.set([entries](const unsigned int i, const unsigned int j) { return entries[i][j]; });
    }

    Linearisation        &linearisation() override { return matrix_; }
    const WeightsByOrder &weights() const override { return weights_; }
    bool                  symmetric() const override { return false; }

    Vector start(const Values &values) const
    {
      Vector x = serial_vector(size_);
      std::copy(values.begin(), values.end(), x.begin());
      return x;
    }

  private:
    unsigned int       size_;
    DenseLinearisation matrix_;
    WeightsByOrder     weights_ = stage_weights(1, 0, 0);
  };

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

namespace
{
  /// Gradient of |x - p|^2/2 + k/4 (|x|^2 - 1)^2, a point that is tied to the unit circle: a Newton step along the circle leaves it to
  /// second order, and k makes that large. With the multiplier z = k (|x|^2 - 1) as local unknown it does not.
  class Circle : public SmallProblem
  {
  public:
    Circle(const double k, const bool mixed)
      : SmallProblem(2)
      , k_(k)
      , mixed_(mixed)
    {
      f        = [this](const Values &x) { return with(x, eliminated(x)); };
      jacobian = [this](const Values &x) { return tangent(x, eliminated(x)); };
    }

    LocalUnknowns start_local() const override { return mixed_ ? local(eliminated({1, 0})) : LocalUnknowns(); }

    Evaluation residual_at(const Vector &x, const LocalUnknowns &z, const bool solved, Vector &r) override
    {
      const Values at(x.begin(), x.end()), values = with(at, solved ? eliminated(at) : z.values[0]); // the equation of z is linear in z
      std::copy(values.begin(), values.end(), r.begin());
      Evaluation evaluation;
      if (!solved)
        evaluation.local = (eliminated(at) - z.values[0]) / k_;
      return evaluation;
    }

    void linearise_at(const Vector &x, const LocalUnknowns &z) override
    {
      const auto keep = jacobian;
      jacobian        = [this, &z](const Values &at) { return tangent(at, z.values[0]); };
      linearise(x);
      jacobian = keep;
    }

    void advance(const Vector &x, const LocalUnknowns &z, const Vector &trial, const double alpha, LocalUnknowns &moved) override
    {
      const Values at(x.begin(), x.end());
      moved =
          local(z.values[0] + alpha * (eliminated(at) - z.values[0]) + 2 * k_ * (at[0] * (trial(0) - x(0)) + at[1] * (trial(1) - x(1))));
    }

  private:
    static LocalUnknowns local(const double z)
    {
      LocalUnknowns result;
      result.values.resize(1);
      result.values[0] = z;
      return result;
    }

    double              eliminated(const Values &x) const { return k_ * (x[0] * x[0] + x[1] * x[1] - 1); }
    Values              with(const Values &x, const double z) const { return {x[0] - 1 + z * x[0], x[1] - 0.3 + z * x[1]}; }
    std::vector<Values> tangent(const Values &x, const double z) const
    {
      return {{1 + z + 2 * k_ * x[0] * x[0], 2 * k_ * x[0] * x[1]}, {2 * k_ * x[0] * x[1], 1 + z + 2 * k_ * x[1] * x[1]}};
    }

    double k_;
    bool   mixed_;
  };
} // namespace

TEST(NonlinearSolver, localUnknownsAsIteratesMakeItIndifferentToStiffConstraints)
{
  std::vector<std::uint64_t> iterations;
  for (const double k : {1e2, 1e4, 1e6})
    {
      Solvers solvers({"relative tolerance=1e-12", "forcing maximum=1e-10", "forcing minimum=1e-12", "absolute tolerance=1e-8"}, {},
                      {"type=direct", "rebuild=every step", "slow iterations=1"});
      Circle  problem(k, true);
      Vector  x                    = problem.start({1, 0});
      const NonlinearReport report = solvers.nonlinear.solve(problem, x);
      ASSERT_TRUE(report.converged) << k << ": " << report.reason;
      EXPECT_NEAR(x(1) / x(0), 0.3, 1e-8) << "the root is on the ray of p";
      EXPECT_EQ(solvers.ledger.counted("line search cuts"), 0u);
      EXPECT_LE(report.final_residual, 1e-8) << "the verdict is that of the function without iterates";
      EXPECT_EQ(report.final_residual, problem.norms.back());
      iterations.push_back(report.iterations);
    }
  EXPECT_LE(iterations[2], iterations[0] + 2);

  Solvers strict({"relative tolerance=1e-12", "absolute tolerance=1e-8"});
  Circle  eliminated(1e4, false);
  Vector  x = eliminated.start({1, 0});
  strict.nonlinear.solve(eliminated, x);
  EXPECT_GT(strict.ledger.counted("line search cuts"), 0u);
  EXPECT_GT(strict.ledger.counted("newton iterations"), iterations[1]);
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
