// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/matrices.h"
#include "../support/solvers.h"

#include <myolines/base/error.h>
#include <myolines/solve/tangent_eigenvalues.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  constexpr unsigned int side = 12;

  /// Five-point Laplacian on a grid of @p side x @p side, less @p shift, with a first difference of strength @p wind.
  DenseLinearisation::Entries grid(const double shift, const double wind = 0)
  {
    return [=](const unsigned int i, const unsigned int j) {
      if (i == j)
        return 4. - shift;
      const bool beside = (i + 1 == j || j + 1 == i) && i / side == j / side, above = i + side == j || j + side == i;
      return beside ? (j > i ? wind - 1 : -wind - 1) : above ? -1. : 0.;
    };
  }

  /// 4 - 2 cos(p pi/(side + 1)) - 2 cos(q pi/(side + 1)) - shift, p, q = 1..side, ascending; most of them are double.
  std::vector<double> closed_form(const double shift)
  {
    std::vector<double> all;
    const double        angle = std::acos(-1.) / (side + 1);
    for (unsigned int p = 1; p <= side; ++p)
      for (unsigned int q = 1; q <= side; ++q)
        all.push_back(4 - 2 * std::cos(p * angle) - 2 * std::cos(q * angle) - shift);
    std::sort(all.begin(), all.end());
    return all;
  }

  std::vector<double> smallest(const DenseLinearisation::Entries &entries, const unsigned int number, const std::string &preconditioner)
  {
    Constraints none;
    none.close();
    WorkLedger         ledger;
    DenseLinearisation matrix(side * side, entries, none, side);
    return smallest_eigenvalues(matrix, false, none, serial_vector(side * side), number,
                                node(LinearSolver::preconditioner_schema(), {"type=" + preconditioner}), ledger);
  }
} // namespace

// 4 from the iteration, with one and with none of them negative, 20 from the dense matrix
TEST(TangentEigenvalues, areThoseOfTheClosedForm)
{
  for (const double shift : {0.02, 0.2})
    for (const std::string preconditioner : {"direct", "jacobi"})
      for (const unsigned int number : {4, 20})
        {
          const auto found = smallest(grid(shift), number, preconditioner), exact = closed_form(shift);
          ASSERT_EQ(found.size(), number);
          for (unsigned int i = 0; i < number; ++i)
            EXPECT_NEAR(found[i], exact[i], 1e-9) << preconditioner << ", shift " << shift << ", number " << i;
        }
}

TEST(TangentEigenvalues, refuseWhatTheyAreNotFor)
{
  EXPECT_THROW(smallest(grid(0, 0.3), 4, "direct"), InputError);
  EXPECT_THROW(smallest(grid(0), side * side + 1, "direct"), InputError);
}
