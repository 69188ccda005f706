// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: L2 differences are those of the functions, on equal, nested and any other meshes.

#include "fields.h"

#include <myolines/compare/differences.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  constexpr double L = 0.03, W = 0.01, H = 0.02; ///< of block_of()

  const Mesh coarse{2, 1}, fine{2, 2}, other{2, 0, {{3, 2, 5}}}, cubic{3, 0, {{2, 1, 3}}};

  dealii::Tensor<1, 3> vector(const double x, const double y, const double z) { return dealii::Tensor<1, 3>({x, y, z}); }

  std::vector<FieldDifference> differences(const BlockFields &first, const BlockFields &second)
  {
    return l2_differences(first, second, MPI_COMM_SELF);
  }

  dealii::Tensor<1, 3> wave(const dealii::Point<3> &x)
  {
    return 1e-3 * vector(std::sin(80 * x[0] + 50 * x[1]), std::cos(60 * x[2]), std::sin(70 * x[1]) * std::cos(40 * x[0]));
  }
} // namespace

/// ||x^2||^2 = L^5/5 W H and so on, for polynomials that all these elements hold.
TEST(Differences, AreThoseOfPolynomials)
{
  const VectorField u      = [](const auto &x) { return vector(x[0] * x[0], 0, 2 * x[1]); },
                    v      = [](const auto &x) { return vector(0, x[1] * x[2], 0); };
  const VectorField w      = [](const auto &x) { return vector(0, 0, 2 * x[1] - 3 * x[0]); };
  const double      norm_u = std::sqrt(W * H * std::pow(L, 5) / 5 + 4 * L * H * std::pow(W, 3) / 3),
               norm_v = std::sqrt(L * std::pow(W * H, 3) / 9), norm_u_w = std::sqrt(W * H * (std::pow(L, 5) / 5 + 9 * std::pow(L, 3) / 3));
  for (const Mesh &one : {coarse, other, cubic})
    for (const Mesh &two : {coarse, fine, other, cubic})
      {
        const auto found = differences(fields(one, u, v), fields(two, w));
        EXPECT_NEAR(found[0].first / norm_u, 1, 1e-12);
        EXPECT_NEAR(found[0].difference / norm_u_w, 1, 1e-12);
        EXPECT_NEAR(found[1].first / norm_v, 1, 1e-12);
        EXPECT_NEAR(found[1].difference / norm_v, 1, 1e-12);
        EXPECT_EQ(found[1].second, 0);
        EXPECT_FALSE(found[1].relative().has_value());
        EXPECT_NEAR(found[0].relative().value(), found[0].difference / found[0].second, 1e-15);
        const auto same = differences(fields(one, u, v), fields(two, u, v));
        EXPECT_LT(same[0].relative().value(), 1e-13);
        EXPECT_LT(same[1].relative().value(), 1e-13);
      }
}

/// u = a x^2 e_x has J = 1 + 2 a x = D_h; a uniform stretch has p = kappa/2 (D - 1/D).
TEST(Differences, OfDilatationAndPressure)
{
  const double      a = 2, stretch = 1.1, D = stretch * stretch * stretch;
  const VectorField bent    = [=](const auto &x) { return vector(a * x[0] * x[0], 0, 0); };
  const VectorField swollen = [=](const auto &x) { return (stretch - 1) * dealii::Tensor<1, 3>(x); };
  const auto        power   = [=](const int n) { return (std::pow(1 + 2 * a * L - D, n) - std::pow(1 - D, n)) / (2 * a * n); };
  const double      kappa   = block_of(coarse).muscle().bulk_modulus;
  for (const Mesh &one : {coarse, other, cubic})
    for (const Mesh &two : {coarse, fine, other})
      {
        const auto found = differences(fields(one, bent), fields(two, swollen));
        EXPECT_EQ(found[3].field, "dilatation");
        EXPECT_NEAR(found[3].second / (D * std::sqrt(L * W * H)), 1, 1e-12);
        EXPECT_NEAR(found[3].difference / std::sqrt(power(3) * W * H), 1, 1e-12);
        EXPECT_EQ(found[2].field, "pressure");
        EXPECT_NEAR(found[2].second / (kappa / 2 * (D - 1 / D) * std::sqrt(L * W * H)), 1, 1e-12);
      }
}

TEST(Differences, OfAStateFromItselfAreZeroAndBothWaysEqual)
{
  for (const Mesh &mesh : {coarse, other, cubic})
    for (const FieldDifference &field : differences(fields(mesh, wave, wave), fields(mesh, wave, wave)))
      EXPECT_EQ(field.difference, 0) << field.field;
  const BlockFields one = fields(coarse, wave), two = fields(other, [](const auto &x) { return 1.1 * wave(x); });
  const auto        there = differences(one, two), back = differences(two, one);
  for (std::size_t f = 0; f < there.size(); ++f)
    {
      EXPECT_DOUBLE_EQ(there[f].difference, back[f].difference);
      EXPECT_DOUBLE_EQ(there[f].first, back[f].second);
    }
}

/// Interpolants of degree k converge with order k + 1, pressure and dilatation, of degree k - 1, with order k.
TEST(Differences, ConvergeAsInterpolationDoes)
{
  const BlockFields finest = fields({3, 3}, wave, wave);
  for (const unsigned int k : {1, 2, 3})
    {
      const auto one = differences(fields({k, 1}, wave, wave), finest), half = differences(fields({k, 2}, wave, wave), finest);
      for (std::size_t f = 0; f < one.size(); ++f)
        EXPECT_NEAR(std::log2(one[f].difference / half[f].difference), f < 2 ? k + 1 : k, 0.15) << k << " " << one[f].field;
    }
}

/// Each rank does its share; `mpirun -np 2` of this program proves it (the test parallel.compare_2).
TEST(Differences, DoNotDependOnTheRanks)
{
  const BlockFields one = fields(coarse, wave), two = fields(other, [](const auto &x) { return 1.1 * wave(x); });
  const auto        alone = differences(one, two), shared = l2_differences(one, two, MPI_COMM_WORLD);
  for (std::size_t f = 0; f < alone.size(); ++f)
    EXPECT_NEAR(alone[f].difference, shared[f].difference, 1e-13 * alone[f].difference);
}

TEST(Differences, PiecesOfNestedAndOfOtherDivisions)
{
  const auto nested = common_pieces(2, 6);
  ASSERT_EQ(nested.size(), 6u);
  EXPECT_EQ(nested[3].first, 1u);
  EXPECT_EQ(nested[3].begin, 0.5);
  const auto both = common_pieces(3, 2);
  ASSERT_EQ(both.size(), 4u);
  EXPECT_DOUBLE_EQ(both[1].begin, 1. / 3);
  EXPECT_DOUBLE_EQ(both[1].length, 1. / 6);
  EXPECT_EQ(both[1].first, 1u);
  EXPECT_EQ(both[1].second, 0u);
  EXPECT_EQ(both[2].second, 1u);
}

/// ||x - x^2/L||^2 = L^3 (1/3 - 1/2 + 1/5).
TEST(Differences, OfRods)
{
  const auto rod = [](const unsigned int elements, const unsigned int degree) {
    Rod1dParameters parameters;
    parameters.length     = 0.1;
    parameters.n_elements = elements;
    parameters.degree     = degree;
    return parameters;
  };
  WorkLedger        ledger;
  const Rod1dSystem one(rod(3, 1), ledger), two(rod(4, 2), ledger);
  const auto        state = [](const Rod1dSystem &system, const std::function<double(double)> &u) {
    Vector x(dealii::complete_index_set(static_cast<unsigned int>(system.n_unknowns())), MPI_COMM_SELF), zero = x;
    for (unsigned int i = 0; i < system.n_unknowns(); ++i)
      x(i) = u(system.position(i));
    return State{0, x, zero, zero};
  };
  const auto found =
      l2_differences(one, state(one, [](const double x) { return x; }), two, state(two, [](const double x) { return x * x / 0.1; }));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].difference, std::sqrt(1e-3 / 30), 1e-15);
  EXPECT_NEAR(found[0].second, std::sqrt(1e-3 / 5), 1e-15);
}
