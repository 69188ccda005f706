// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/matrices.h"
#include "../support/solvers.h"

#include <myolines/solve/preconditioner.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  const WeightsByOrder weights = stage_weights(1, 0, 0);

  /// Five-point Laplacian on a w x w grid (h = 1), plus a first difference of strength @p wind, minus @p shift.
  DenseLinearisation::Entries grid_operator(const unsigned int w, const double wind = 0, const double shift = 0)
  {
    return [=](const unsigned int i, const unsigned int j) {
      if (i == j)
        return 4. - shift;
      const bool beside = (i + 1 == j || j + 1 == i) && i / w == j / w;
      const bool above  = i + w == j || j + w == i;
      if (!beside && !above)
        return 0.;
      return -1. + (beside ? (j > i ? wind : -wind) : 0.);
    };
  }

  Vector wavy(const unsigned int n)
  {
    Vector x = serial_vector(n);
    for (unsigned int i = 0; i < n; ++i)
      x(i) = 1 + std::sin(0.7 * i) + 0.3 * std::cos(2.1 * i);
    return x;
  }

  double error(const Vector &x, const Vector &exact)
  {
    Vector difference = x;
    difference -= exact;
    return difference.l2_norm() / exact.l2_norm();
  }

  struct Result
  {
    LinearReport report;
    double       error;
  };

  Result solve(Solvers &solvers, DenseLinearisation &matrix, const Constraints &constraints, const unsigned int n, const bool symmetric,
               const double tolerance)
  {
    const Vector exact = wavy(n);
    Vector       b(exact), x(exact);
    matrix.apply(weights, exact, b);
    x                         = 17; // what was there must not matter
    const LinearReport report = solvers.linear.solve(matrix, weights, constraints, symmetric, b, x, tolerance);
    return {report, error(x, exact)};
  }
} // namespace

class EachPreconditioner : public ::testing::TestWithParam<std::string>
{
};

TEST_P(EachPreconditioner, solvesSymmetricAndNonSymmetricSystems)
{
  const unsigned int width = 30;
  const Constraints  none;
  for (const double wind : {0., 0.5})
    {
      Solvers            solvers({}, {}, {"type=" + GetParam()});
      DenseLinearisation matrix(width * width, grid_operator(width, wind), none, width);
      const Result       result = solve(solvers, matrix, none, width * width, wind == 0, 1e-10);
      EXPECT_TRUE(result.report.converged) << result.report.reason;
      EXPECT_LE(result.report.relative_residual, 1e-10);
      EXPECT_LT(result.error, 1e-7);
      EXPECT_EQ(solvers.ledger.counted("krylov fallbacks"), 0u);
      EXPECT_EQ(solvers.ledger.counted("preconditioner set-ups"), 1u);
      EXPECT_EQ(solvers.ledger.counted("linear iterations"), result.report.iterations);
    }
}

TEST_P(EachPreconditioner, fallsBackToGmresOnAnIndefiniteMatrix)
{
  // Eigenvalues 4 - 2 cos - 2 cos - 1.3: some negative, none near zero.
  const unsigned int width = 12;
  const Constraints  none;
  Solvers            solvers({}, {}, {"type=" + GetParam()});
  DenseLinearisation matrix(width * width, grid_operator(width, 0, 1.3), none, width);
  const Result       result = solve(solvers, matrix, none, width * width, true, 1e-9);
  EXPECT_TRUE(result.report.converged) << result.report.reason;
  EXPECT_LT(result.error, 1e-6);
  if (GetParam() == "jacobi")
    {
      EXPECT_GE(solvers.ledger.counted("krylov fallbacks"), 1u);
    }
}

INSTANTIATE_TEST_SUITE_P(registry, EachPreconditioner, ::testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const PreconditionerEntry &entry : preconditioner_registry())
                             if (entry.name != "p multigrid") // needs two levels, see the tests of the muscle
                               names.push_back(entry.name);
                           return names;
                         }()));

TEST(LinearSolver, factorisesProblemsAboveTheLimitOfKlu)
{
  const unsigned int width = 50; // 2500 unknowns
  const Constraints  none;
  Solvers            solvers({}, {}, {"type=direct"});
  DenseLinearisation matrix(width * width, grid_operator(width, 0.3), none, width);
  const Result       result = solve(solvers, matrix, none, width * width, false, 1e-10);
  EXPECT_TRUE(result.report.converged) << result.report.reason;
  EXPECT_LT(result.error, 1e-10);
  EXPECT_EQ(result.report.iterations, 1u);
}

TEST(LinearSolver, leavesConstrainedUnknownsOut)
{
  const unsigned int width = 10, n = width * width;
  Constraints        constraints;
  for (const unsigned int fixed : {0u, 37u, 99u})
    constraints.add_line(fixed);
  constraints.close();
  for (const char *type : {"direct", "jacobi", "ml"})
    {
      Solvers            solvers({}, {}, {std::string("type=") + type});
      DenseLinearisation matrix(n, grid_operator(width, 0.2), constraints, width);
      Vector             exact = wavy(n), b(exact), x(exact);
      constraints.set_zero(exact);
      matrix.apply(weights, exact, b);
      b(37)                     = 1e6; // a reaction, to be ignored
      const LinearReport report = solvers.linear.solve(matrix, weights, constraints, false, b, x, 1e-11);
      EXPECT_TRUE(report.converged) << type << ": " << report.reason;
      EXPECT_LT(error(x, exact), 1e-8) << type;
      EXPECT_EQ(x(0), 0);
      EXPECT_EQ(x(37), 0);
    }
}

TEST(LinearSolver, keepsTheFactorisationWhileItConvergesFast)
{
  const unsigned int width = 20, n = width * width;
  const Constraints  none;
  for (const std::string policy : {"when slow", "every step"})
    {
      Solvers            solvers({}, {}, {"type=direct", "rebuild=" + policy});
      DenseLinearisation matrix(n, grid_operator(width), none, width);
      for (unsigned int step = 0; step < 5; ++step)
        {
          solvers.linear.new_step();
          matrix.set(grid_operator(width, 0.01 * step));
          const Result result = solve(solvers, matrix, none, n, false, 1e-8);
          EXPECT_TRUE(result.report.converged) << result.report.reason;
          EXPECT_LT(result.error, 1e-5);
        }
      EXPECT_EQ(solvers.ledger.counted("preconditioner set-ups"), policy == "when slow" ? 1u : 5u);
    }
}

TEST(LinearSolver, rebuildsAKeptPreconditionerThatFails)
{
  const unsigned int width = 15, n = width * width;
  const Constraints  none;
  Solvers            solvers({}, {"maximum iterations=5"}, {"type=direct", "rebuild=when slow"});
  DenseLinearisation matrix(n, grid_operator(width), none, width);
  EXPECT_TRUE(solve(solvers, matrix, none, n, false, 1e-8).report.converged);
  matrix.set(grid_operator(width, 0, 1.3)); // another matrix altogether
  const Result result = solve(solvers, matrix, none, n, false, 1e-8);
  EXPECT_TRUE(result.report.converged) << result.report.reason;
  EXPECT_EQ(solvers.ledger.counted("preconditioner set-ups"), 2u);
}

TEST(LinearSolver, saysWhyItFailed)
{
  const Constraints none;
  {
    Solvers            solvers({}, {"maximum iterations=3"}, {"type=jacobi"});
    DenseLinearisation matrix(900, grid_operator(30), none, 30);
    const Result       result = solve(solvers, matrix, none, 900, true, 1e-10);
    EXPECT_FALSE(result.report.converged);
    EXPECT_NE(result.report.reason.find("3 iterations"), std::string::npos) << result.report.reason;
    EXPECT_GT(result.report.relative_residual, 1e-10);
  }
  {
    Solvers            solvers({}, {}, {"type=direct"});
    DenseLinearisation matrix(
        2, [](unsigned int, unsigned int) { return 1.; }, none, 2); // singular
    Vector b = serial_vector(2), x = serial_vector(2);
    b(0)                      = 1;
    const LinearReport report = solvers.linear.solve(matrix, weights, none, false, b, x, 1e-10);
    EXPECT_FALSE(report.converged);
    EXPECT_FALSE(report.reason.empty());
  }
}

TEST(LinearSolver, multilevelIsReproducible)
{
  const unsigned int  width = 40, n = width * width;
  const Constraints   none;
  std::vector<double> first;
  for (unsigned int run = 0; run < 2; ++run)
    {
      Solvers            solvers({}, {}, {"type=ml", "coarse size=20"});
      DenseLinearisation matrix(n, grid_operator(width), none, width);
      Vector             b = wavy(n), x(b);
      ASSERT_TRUE(solvers.linear.solve(matrix, weights, none, true, b, x, 1e-8).converged);
      const std::vector<double> values(x.begin(), x.end());
      if (run == 0)
        first = values;
      else
        EXPECT_EQ(values, first);
    }
}

TEST(LinearSolver, outlivesTheMatricesItWorkedOn)
{
  // Both factorisations and hierarchies look at their matrix while they are destroyed.
  const Constraints none;
  for (const char *type : {"direct", "ml"})
    {
      Solvers solvers({}, {}, {std::string("type=") + type});
      {
        DenseLinearisation matrix(900, grid_operator(30), none, 30);
        EXPECT_TRUE(solve(solvers, matrix, none, 900, true, 1e-8).report.converged);
      }
      solvers.linear.forget();
      DenseLinearisation matrix(1600, grid_operator(40, 0.2), none, 40);
      EXPECT_TRUE(solve(solvers, matrix, none, 1600, false, 1e-8).report.converged) << type;
    }
}
