// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/interpolation.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    Vector vector_of(const std::vector<double> &numbers)
    {
      Vector x(static_cast<unsigned int>(numbers.size()));
      for (unsigned int i = 0; i < x.size(); ++i)
        x[i] = numbers[i];
      return x;
    }

    std::vector<double> numbers_of(const Vector &x) { return {x.begin(), x.begin() + x.locally_owned_size()}; }

    /// Two coarse nodes, three fine ones: the first of them at the first, one between, the last at the second and held in y.
    Interpolation from_ends_to_the_middle()
    {
      const bool    nothing[3] = {false, false, false}, y[3] = {false, true, false};
      Interpolation P;
      P.add_row({{0, 1.}}, nothing);
      P.add_row({{0, 0.25}, {1, 0.75}}, nothing);
      P.add_row({{1, 1.}}, y);
      return P;
    }

    TEST(Interpolation, AddsWeightedNodes)
    {
      const Interpolation P    = from_ends_to_the_middle();
      Vector              fine = vector_of({1, 1, 1, 1, 1, 1, 1, 1, 1});
      P.add(vector_of({4, 8, 12, -4, 0, 16}), fine);
      EXPECT_EQ(numbers_of(fine), (std::vector<double>{5, 9, 13, -1, 3, 16, -3, 1, 17}));
    }

    /// y . P x = P^T y . x
    TEST(Interpolation, RestrictsByItsTranspose)
    {
      const Interpolation P = from_ends_to_the_middle();
      const Vector        x = vector_of({4, 8, 12, -4, 3, 16}), y = vector_of({1, -2, 3, -4, 5, -6, 7, -8, 9});
      Vector              Px = vector_of(std::vector<double>(9)), PTy = vector_of({9, 9, 9, 9, 9, 9});
      P.add(x, Px);
      P.restrict_to(y, PTy);
      EXPECT_EQ(numbers_of(PTy), (std::vector<double>{0, -0.75, 1.5, 4, 3.75, 4.5})) << "nothing is left of what was there";
      EXPECT_EQ(y * Px, PTy * x);
    }
  } // namespace
} // namespace myolines
