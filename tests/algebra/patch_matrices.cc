// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/patch_matrices.h>

#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

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
              patches.add(p, i, j, matrices[p](i, j));
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
            EXPECT_LT(z.linfty_norm(), 1e-5 * expected.linfty_norm()) << name(isa);
          }
    }

    TEST(PatchMatrices, FallBackToTheRowSumsOfIndefiniteMatrices)
    {
      PatchMatrices patches({{0, 1}}, Vector(2));
      patches.add(0, 0, 0, 1);
      patches.add(0, 1, 0, 2);
      patches.add(0, 1, 1, -2);
      EXPECT_EQ(patches.invert(), 1u);
      Vector r(2), z(2);
      r(0) = 3;
      r(1) = 4;
      patches.apply(r, z);
      EXPECT_FLOAT_EQ(z(0), 1);
      EXPECT_FLOAT_EQ(z(1), 1);
    }
  } // namespace
} // namespace myolines
