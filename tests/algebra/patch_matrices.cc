// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/patch_matrices.h>

#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace myolines
{
  namespace
  {
    /// Overlapping runs of unknowns of different length, with random positive definite matrices.
    struct Patches
    {
      explicit Patches(const unsigned int n)
        : layout(n)
      {
        std::mt19937                           engine(7);
        std::uniform_real_distribution<double> random(-1, 1);
        for (unsigned int p = 0; p < 19; ++p)
          {
            std::vector<unsigned int> unknowns;
            for (unsigned int i = 0; i < 3 + p % 6; ++i)
              unknowns.push_back((2 * p + 3 * i) % n);
            dealii::FullMatrix<double> B(unknowns.size()), A(unknowns.size());
            for (unsigned int i = 0; i < B.m(); ++i)
              for (unsigned int j = 0; j < B.m(); ++j)
                B(i, j) = random(engine);
            B.Tmmult(A, B);
            for (unsigned int i = 0; i < B.m(); ++i)
              A(i, i) += 1;
            sets.push_back(unknowns);
            matrices.push_back(A);
          }
      }
      void fill(PatchMatrices &patches) const
      {
        for (unsigned int p = 0; p < sets.size(); ++p)
          for (unsigned int i = 0; i < sets[p].size(); ++i)
            for (unsigned int j = 0; j <= i; ++j)
              patches.entry(p, i, j) += matrices[p](i, j);
      }
      Vector                                  layout;
      std::vector<std::vector<unsigned int>>  sets;
      std::vector<dealii::FullMatrix<double>> matrices;
    };

    TEST(PatchMatrices, ApplyTheSumOfInverses)
    {
      const unsigned int n = 53;
      const Patches      given(n);
      std::vector<int>   sharing(n, 0);
      for (const auto &set : given.sets)
        for (const unsigned int u : set)
          ++sharing[u];

      Vector r(n), expected(n), z(n);
      for (unsigned int i = 0; i < n; ++i)
        r(i) = std::sin(1. + i);
      for (unsigned int p = 0; p < given.sets.size(); ++p)
        {
          const auto                &set = given.sets[p];
          dealii::FullMatrix<double> inverse(set.size());
          inverse.invert(given.matrices[p]);
          for (unsigned int i = 0; i < set.size(); ++i)
            for (unsigned int j = 0; j < set.size(); ++j)
              expected(set[i]) += inverse(i, j) * r(set[j]);
        }
      for (const InstructionSet isa : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
        if (isa <= widest_instruction_set())
          {
            PatchMatrices patches(given.sets, given.layout, isa);
            given.fill(patches);
            EXPECT_EQ(patches.invert(), 0u);
            EXPECT_EQ(patches.overlap(), *std::max_element(sharing.begin(), sharing.end()));
            patches.apply(r, z);
            z -= expected;
            EXPECT_LT(z.linfty_norm(), (isa == InstructionSet::baseline ? 1e-5 : 2e-3) * expected.linfty_norm()) << name(isa);
          }
    }

    TEST(PatchMatrices, AreTheSameWhenTheyAreCompletedOneAfterTheOther)
    {
      const unsigned int n = 53;
      const Patches      given(n);
      PatchMatrices      at_once(given.sets, given.layout), one_by_one(given.sets, given.layout);
      given.fill(at_once);
      for (unsigned int p = 0; p < given.sets.size(); ++p)
        {
          for (unsigned int i = 0; i < given.sets[p].size(); ++i)
            for (unsigned int j = 0; j <= i; ++j)
              one_by_one.entry(p, i, j) += given.matrices[p](i, j);
          one_by_one.complete(p);
        }
      EXPECT_EQ(at_once.invert(), 0u);
      EXPECT_EQ(one_by_one.invert(), 0u);
      Vector r(n), expected(n), z(n);
      for (unsigned int i = 0; i < n; ++i)
        r(i) = std::cos(1. + i);
      at_once.apply(r, expected);
      one_by_one.apply(r, z);
      EXPECT_TRUE(std::equal(z.begin(), z.end(), expected.begin()));
      EXPECT_GT(expected.linfty_norm(), 0);
    }

    /// As in a patch of a nearly incompressible body: a few directions are stiff, with any unit of force. Rounding of the inverse itself
    /// by eps would move eigenvalues of S A by eps times their quotient.
    TEST(PatchMatrices, KeepStiffAndSoftDirectionsApart)
    {
      const unsigned int                     n = 81, n_stiff = 32;
      std::mt19937                           engine(11);
      std::uniform_real_distribution<double> random(-1, 1);
      dealii::FullMatrix<double>             B(n, n_stiff), A(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < n_stiff; ++k)
          B(i, k) = random(engine);
      std::vector<unsigned int> all(n);
      std::iota(all.begin(), all.end(), 0u);
      for (const double unit : {1e-9, 1., 1e9})
        for (const double stiff : {1e2, 1e4, 1e6})
          {
            B.mTmult(A, B);
            A *= unit * stiff / n;
            PatchMatrices patches({all}, Vector(n));
            for (unsigned int i = 0; i < n; ++i)
              {
                A(i, i) += unit;
                for (unsigned int j = 0; j <= i; ++j)
                  patches.entry(0, i, j) = A(i, j);
              }
            EXPECT_EQ(patches.invert(), 0u);
            // Eigenvalues of S A are within its norm in the energy of A of those of the identity: power iteration on (S A - 1)^2.
            Vector x(n), y(n), z(n);
            for (unsigned int i = 0; i < n; ++i)
              x(i) = random(engine);
            double size = 0;
            for (unsigned int k = 0; k < 60; ++k)
              {
                x /= x.l2_norm();
                for (unsigned int i = 0; i < n; ++i)
                  {
                    y(i) = 0;
                    for (unsigned int j = 0; j < n; ++j)
                      y(i) += A(i, j) * x(j);
                  }
                patches.apply(y, z);
                z.add(-1, x);
                size = z.l2_norm();
                x    = z;
              }
            EXPECT_LT(size, 0.3) << stiff;
          }
    }

    TEST(PatchMatrices, FallBackToTheRowSumsOfIndefiniteMatrices)
    {
      PatchMatrices patches({{0, 1}}, Vector(2));
      patches.entry(0, 0, 0) = 1;
      patches.entry(0, 1, 0) = 2;
      patches.entry(0, 1, 1) = -2;
      EXPECT_EQ(patches.invert(), 1u);
      Vector r(2), z(2);
      r(0) = 3;
      r(1) = 4;
      patches.apply(r, z);
      EXPECT_NEAR(z(0), 1, 1e-3);
      EXPECT_NEAR(z(1), 1, 1e-3);
    }
  } // namespace
} // namespace myolines
