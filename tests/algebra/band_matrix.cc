// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/band_matrix.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;

TEST(BandMatrix, solvesWithRowExchanges)
{
  const unsigned int n = 9;
  for (const unsigned int bandwidth : {1u, 2u, 3u})
    {
      BandMatrix          a(n, bandwidth);
      std::vector<double> x(n), b(n);
      a.clear();
      for (unsigned int i = 0; i < n; ++i)
        x[i] = std::sin(1. + i);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i < bandwidth ? 0 : i - bandwidth; j < std::min(n, i + bandwidth + 1); ++j)
          {
            a(i, j) = i == j ? 1e-3 : std::cos(3. * i + j); // small diagonal: pivots must be sought
            b[i] += a(i, j) * x[j];
          }
      ASSERT_TRUE(a.factorise());
      a.solve(b.data());
      for (unsigned int i = 0; i < n; ++i)
        EXPECT_NEAR(b[i], x[i], 1e-11) << "bandwidth " << bandwidth << ", row " << i;
    }
}

TEST(BandMatrix, saysSoIfThereIsNoInverse)
{
  BandMatrix a(3, 1);
  a.clear();
  a(0, 0) = a(2, 2) = 1;
  EXPECT_FALSE(a.factorise());
  a.clear();
  a(0, 0) = a(1, 1) = 1;
  a(2, 2)           = std::nan("");
  EXPECT_FALSE(a.factorise());
}

TEST(BandMatrix, hasNoMoreDiagonalsThanRows)
{
  BandMatrix a(1, 3);
  EXPECT_EQ(a.bandwidth(), 0u);
  a.clear();
  a(0, 0) = 4;
  ASSERT_TRUE(a.factorise());
  double x = 2;
  a.solve(&x);
  EXPECT_EQ(x, 0.5);
}
