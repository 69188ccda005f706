// SPDX-License-Identifier: LGPL-2.1-or-later
#include "small_problem.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;
using namespace myolines::testing;

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
