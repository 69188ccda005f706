// SPDX-License-Identifier: LGPL-2.1-or-later
// Newton's method on bands makes the same steps as the general one: lift, line search, inadmissible points, convergence.

#include "../support/matrices.h"
#include "../support/solvers.h"

#include <myolines/system/band_linearisation.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  /// Springs in a row, f_i = s(x_i - x_(i-1)) - s(x_(i+1) - x_i) with s(e) = log(1 + e): inadmissible from e = -1 on. The ends
  /// are constrained.
  class Springs : public NonlinearProblem
  {
    class Bands : public BandLinearisation
    {
    public:
      explicit Bands(Springs &problem)
        : problem_(problem)
        , sparse_(
              problem.size(), [this](unsigned int i, unsigned int j) { return entry(i, j); }, problem.constraints_, 1)
      {}
      void move()
      {
        ++version_;
        sparse_.set([this](unsigned int i, unsigned int j) { return entry(i, j); });
      }
      unsigned int        bandwidth() const override { return 1; }
      std::uint64_t       version() const override { return version_; }
      void                apply(const WeightsByOrder &w, const Vector &x, Vector &y) const override { sparse_.apply(w, x, y); }
      const SparseMatrix &sparse(const WeightsByOrder &w) override { return sparse_.sparse(w); }
      void                fill(const WeightsByOrder &, BandMatrix &matrix) const override
      {
        matrix.clear();
        const unsigned int last = problem_.size() - 1;
        for (unsigned int i = 0; i <= last; ++i)
          for (unsigned int j = i == 0 ? 0 : i - 1; j <= std::min(last, i + 1); ++j)
            matrix(i, j) = i == 0 || j == 0 || i == last || j == last ? 1. * (i == j) : entry(i, j);
      }

    private:
      double entry(const unsigned int i, const unsigned int j) const
      {
        const auto slope = [&](const unsigned int k) {
          return k >= 1 && k < problem_.size() ? 1 / (1 + problem_.at_[k] - problem_.at_[k - 1]) : 0;
        };
        return i == j ? slope(i) + slope(i + 1) : -slope(std::max(i, j));
      }
      Springs           &problem_;
      DenseLinearisation sparse_;
      std::uint64_t      version_ = 0;
    };

  public:
    Springs(const unsigned int size, const double target)
      : target_(target)
      , at_(size)
    {
      constraints_.add_line(0);
      constraints_.add_line(size - 1);
      constraints_.close();
      bands_ = std::make_unique<Bands>(*this);
    }

    unsigned int       size() const { return at_.size(); }
    const Constraints &constraints() const override { return constraints_; }
    void               impose(Vector &x) const override
    {
      x(0)          = 0;
      x(size() - 1) = target_;
    }
    Evaluation residual(const Vector &x, Vector &f) override
    {
      ++evaluations;
      f = 0;
      for (unsigned int k = 1; k < size(); ++k)
        {
          const double e = x(k) - x(k - 1);
          if (e <= -1)
            return {false, "a spring is turned inside out"};
          f(k) += std::log1p(e);
          f(k - 1) -= std::log1p(e);
        }
      return {};
    }
    void linearise(const Vector &x) override
    {
      at_.assign(x.begin(), x.end());
      bands_->move();
    }
    Linearisation        &linearisation() override { return *bands_; }
    const WeightsByOrder &weights() const override { return weights_; }
    bool                  symmetric() const override { return true; }

    unsigned int evaluations = 0;

  private:
    double                 target_;
    std::vector<double>    at_;
    Constraints            constraints_;
    std::unique_ptr<Bands> bands_;
    WeightsByOrder         weights_ = stage_weights(1, 0, 0);
  };
} // namespace

TEST(BandNewton, makesTheStepsOfTheGeneralSolver)
{
  for (const double target : {0.5, 3., -2.5}) // the last begins with inadmissible full steps
    {
      const Overrides settings = {"relative tolerance=1e-12", "absolute tolerance=0", "forcing minimum=1e-13", "forcing maximum=1e-12"};
      Springs         one(6, target), other(6, target);
      Solvers         bands(settings), general(settings, {}, {"type=direct"});
      Vector          x = serial_vector(6), y = serial_vector(6);
      x(2) = y(2) = 0.7;
      x(3) = y(3)                 = -0.1;
      const NonlinearReport left  = bands.nonlinear.solve(one, x);
      const NonlinearReport right = general.nonlinear.solve(other, y);
      ASSERT_TRUE(left.converged) << left.reason;
      ASSERT_TRUE(right.converged) << right.reason;
      EXPECT_EQ(left.iterations, right.iterations) << target;
      EXPECT_EQ(left.residual_evaluations, right.residual_evaluations) << target;
      EXPECT_EQ(left.residual_evaluations, one.evaluations);
      EXPECT_EQ(bands.ledger.counted("line search cuts"), general.ledger.counted("line search cuts"));
      EXPECT_NEAR(left.initial_residual, right.initial_residual, 1e-12);
      for (unsigned int i = 0; i < 6; ++i)
        EXPECT_NEAR(x(i), target * i / 5, 1e-11) << "springs in a row share the length";
    }
}

TEST(BandNewton, saysWhyItFails)
{
  {
    Springs               inside_out(4, -4); // no admissible place for the nodes
    Solvers               solvers;
    Vector                x      = serial_vector(4);
    const NonlinearReport report = solvers.nonlinear.solve(inside_out, x);
    EXPECT_FALSE(report.converged);
    EXPECT_FALSE(report.reason.empty());
  }
  {
    Springs slow(6, 2);
    Solvers solvers({"maximum iterations=1", "relative tolerance=1e-12", "absolute tolerance=0"});
    Vector  x                    = serial_vector(6);
    x(2)                         = 0.7;
    const NonlinearReport report = solvers.nonlinear.solve(slow, x);
    EXPECT_FALSE(report.converged);
    EXPECT_NE(report.reason.find("after 1 Newton iterations"), std::string::npos) << report.reason;
  }
  {
    Springs bad_guess(4, 0);
    Solvers solvers;
    Vector  x                    = serial_vector(4);
    x(1)                         = 5;
    const NonlinearReport report = solvers.nonlinear.solve(bad_guess, x);
    EXPECT_TRUE(report.inadmissible);
    EXPECT_NE(report.reason.find("the first guess is inadmissible"), std::string::npos) << report.reason;
  }
}
