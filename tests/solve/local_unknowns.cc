// SPDX-License-Identifier: LGPL-2.1-or-later
#include "small_problem.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  /// Gradient of |x - p|^2/2 + k/4 (|x|^2 - 1)^2, a point that is tied to the unit circle: a Newton step along the circle leaves it to
  /// second order, and k makes that large. With the multiplier z = k (|x|^2 - 1) as local unknown it does not. At x, z the equations of a
  /// Newton step are (1 + z) dx + x dz = -f, x . dx - dz/(2 k) = -g with g = (|x|^2 - 1 - z/k)/2.
  class Circle : public SmallProblem, public LocalEquations
  {
    /// The matrix and these equations. @p keeps: its action claims to be cheap.
    class Tangent : public DenseLinearisation
    {
    public:
      Tangent(const Circle &circle, const bool keeps)
        : DenseLinearisation(
              2,
              [&circle](const unsigned int i, const unsigned int j) {
                return (i == j ? 1 + circle.z_ : 0) + 2 * circle.k_ * circle.x_[i] * circle.x_[j];
              },
              circle.relations, 2)
        , circle_(circle)
        , keeps_(keeps)
      {}
      const LocalEquations *local() const override { return &circle_; }
      bool                  action_is_cheap() const override { return keeps_; }

    private:
      const Circle &circle_;
      bool          keeps_;
    };

    class Multiplier : public Elimination
    {
    public:
      Multiplier(const Values &x, const double W)
        : x_(x)
        , W_(W)
      {}
      void condense(const Vector &b_z, Vector &b) const override
      {
        for (const unsigned int i : {0, 1})
          b(i) += x_[i] * W_ * b_z(0);
      }
      void recover(const double weight, const Vector &x, const Vector &b_z, Vector &z) const override
      {
        z(0) = W_ * (x_[0] * x(0) + x_[1] * x(1) - b_z(0) / weight);
      }

    private:
      Values x_;
      double W_;
    };

  public:
    Circle(const double k, const bool mixed, const bool keeps = false)
      : SmallProblem(2)
      , k_(k)
      , mixed_(mixed)
      , tangent_(*this, keeps)
    {
      f = [this](const Values &x) { return with(x, eliminated(x)); };
    }

    Linearisation &linearisation() override { return tangent_; }
    void           linearise(const Vector &x) override
    {
      x_ = {x(0), x(1)};
      z_ = eliminated(x_);
    }

    LocalUnknowns start_local() const override { return mixed_ ? local(eliminated({1, 0})) : LocalUnknowns(); }

    Evaluation residual_at(const Vector &x, const LocalUnknowns &z, Vector &r) override
    {
      const Values at(x.begin(), x.end()), values = with(at, z.values[0]);
      std::copy(values.begin(), values.end(), r.begin());
      Evaluation evaluation;
      evaluation.local = (eliminated(at) - z.values[0]) / k_;
      return evaluation;
    }

    void linearise_at(const Vector &x, const LocalUnknowns &z) override
    {
      linearise(x);
      z_ = z.values[0];
    }

    void advance(const LocalUnknowns &z, const Vector &dz, const Vector &, const double alpha, LocalUnknowns &moved) override
    {
      moved = local(z.values[0] + alpha * dz(0));
    }

    Vector make_local() const override { return serial_vector(1); }
    Vector local_scale(const bool eliminated) const override
    {
      Vector scale = serial_vector(1);
      scale        = eliminated ? 2 * k_ : 2;
      return scale;
    }
    void apply_with_local(const WeightsByOrder &w, Digits, const Vector &x, const Vector &z, Vector &y, Vector &y_z) const override
    {
      for (const unsigned int i : {0, 1})
        y(i) = w[2].u * ((1 + z_) * x(i) + x_[i] * z(0));
      y_z(0) = w[2].u * (x_[0] * x(0) + x_[1] * x(1) - z(0) / (2 * k_));
    }
    void                         local_residual(Vector &g) const override { g(0) = (eliminated(x_) - z_) / (2 * k_); }
    void                         local_residual(Vector &g) override { static_cast<const Circle &>(*this).local_residual(g); }
    std::unique_ptr<Elimination> eliminate(const bool softened) const override
    {
      return std::make_unique<Multiplier>(x_, softened ? 1 / (1 / (2 * k_) + 0.1) : 2 * k_);
    }

  private:
    static LocalUnknowns local(const double z)
    {
      LocalUnknowns result;
      result.values.resize(1);
      result.values[0] = z;
      return result;
    }

    double eliminated(const Values &x) const { return k_ * (x[0] * x[0] + x[1] * x[1] - 1); }
    Values with(const Values &x, const double z) const { return {x[0] - 1 + z * x[0], x[1] - 0.3 + z * x[1]}; }

    double  k_;
    bool    mixed_;
    Values  x_{1, 0}; ///< of the last linearisation, with
    double  z_ = 0;
    Tangent tangent_;
  };
} // namespace

TEST(NonlinearSolver, localUnknownsAsIteratesMakeItIndifferentToStiffConstraints)
{
  std::vector<std::uint64_t> iterations;
  for (const bool keeps : {false, true})
    for (const double k : {1e2, 1e4, 1e6})
      {
        Solvers solvers({"relative tolerance=1e-12", "forcing maximum=1e-10", "forcing minimum=1e-12", "absolute tolerance=1e-8"}, {},
                        {"type=direct", "rebuild=every step", "slow iterations=1"});
        Circle  problem(k, true, keeps);
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
  for (const unsigned int i : {0, 1, 2})
    EXPECT_EQ(iterations[i + 3], iterations[i]) << "kept or eliminated in the linear solves";

  Solvers strict({"relative tolerance=1e-12", "absolute tolerance=1e-8"});
  Circle  eliminated(1e4, false);
  Vector  x = eliminated.start({1, 0});
  strict.nonlinear.solve(eliminated, x);
  EXPECT_GT(strict.ledger.counted("line search cuts"), 0u);
  EXPECT_GT(strict.ledger.counted("newton iterations"), iterations[1]);
}
