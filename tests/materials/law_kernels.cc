// SPDX-License-Identifier: LGPL-2.1-or-later
// Laws on points of a batch, for every instruction set, and their declarations.
#include "law_states.h"

#include <myolines/materials/law_kernels.h>
#include <myolines/materials/laws.h>
#include <myolines/materials/tissue.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    using namespace test;

    TEST(LawKernels, KernelsOfAllInstructionSetsAddThem)
    {
      const std::vector<Deformation<double>> all = states();
      using T                                    = Lanes<InstructionSet::avx512>; // memory of the widest alignment
      alignas(64) T material[n_material_values], F[9], rate[9], geometry[10];
      for (T &x : material)
        x = T(0.);
      for (int lane = 0; lane < n_lanes; ++lane)
        {
          for (int i = 0; i < 3; ++i)
            material[i].set(lane, all[lane].a0[i]);
          material[material_tissue].set(lane, lane < 6 ? 2 : 5);
          material[material_fat].set(lane, 0.25);
          for (int i = 0; i < 9; ++i)
            {
              F[i].set(lane, all[lane].F.entry[i]);
              rate[i].set(lane, all[lane].F_rate.entry[i]);
              geometry[i].set(lane, i % 4 == 0 ? 2. : 0.1);
            }
          geometry[9].set(lane, 3.);
        }
      const auto   doubles = [](T *x) { return reinterpret_cast<double *>(x); };
      const double weight  = 0.5;
      Activation   activation;
      activation.level[0] = 0.7;
      const LawPoints points{1, doubles(F), 0, doubles(rate), doubles(material), 0, doubles(geometry), 0, &weight, &activation, nullptr};
      for (const LawKind &kind : law_kinds())
        {
          SCOPED_TRACE(kind.name);
          const auto                                                 law = kind.make(nullptr);
          const LawTerm                                              term{kind.kernels.data(), law->data(), 2., 2};
          std::vector<std::pair<InstructionSet, const LawKernels *>> sets{
              {InstructionSet::baseline, &law_kernels<InstructionSet::baseline>(term)}};
          if (widest_instruction_set() >= InstructionSet::avx2)
            sets.emplace_back(InstructionSet::avx2, &law_kernels<InstructionSet::avx2>(term));
          if (widest_instruction_set() >= InstructionSet::avx512)
            sets.emplace_back(InstructionSet::avx512, &law_kernels<InstructionSet::avx512>(term));
          for (const auto &[set, kernels] : sets)
            for (const bool symmetrised : {false, true})
              {
                SCOPED_TRACE(std::string(name(set)) + (symmetrised ? " symmetrised" : ""));
                alignas(64) T P[9], dP[9], c[81];
                for (T &x : P)
                  x = T(1.);
                for (T &x : dP)
                  x = T(1.);
                for (T &x : c)
                  x = T(1.);
                const LawWeights w{1, 30, symmetrised};
                kernels->stress(term, points, doubles(P));
                kernels->action(term, points, w, doubles(rate), doubles(dP));
                kernels->coefficients(term, points, w, doubles(c));
                for (int lane = 0; lane < n_lanes; ++lane)
                  {
                    const double share = lane < 6 ? 2 * 0.75 : 0, JxW = 3 * weight;
                    const Matrix expected = law->stress(strain(all[lane]));
                    double       A[9][9], action = 0, scale = 0;
                    law->moduli(all[lane], 1, 30, A);
                    for (int i = 0; i < 9; ++i)
                      for (int j = 0; j < 9; ++j)
                        scale = std::max(scale, std::abs(A[i][j]));
                    const auto modulus = [&](const int i, const int j) { return symmetrised ? (A[i][j] + A[j][i]) / 2 : A[i][j]; };
                    for (int i = 0; i < 9; ++i)
                      {
                        EXPECT_NEAR(P[i][lane], 1 + share * expected.entry[i], 1e-12 * (1 + size(expected)));
                        action = 0;
                        for (int j = 0; j < 9; ++j)
                          action += modulus(i, j) * all[lane].F_rate.entry[j];
                        EXPECT_NEAR(dP[i][lane], 1 + share * JxW * action, 1e-11 * (1 + scale));
                      }
                    const auto inverse = [](const int X, const int J) { return X == J ? 2. : 0.1; };
                    for (int a = 0; a < 3; ++a)
                      for (int b = 0; b < 3; ++b)
                        for (int X = 0; X < 3; ++X)
                          for (int Y = 0; Y < 3; ++Y)
                            {
                              double sum = 0;
                              for (int I = 0; I < 3; ++I)
                                for (int K = 0; K < 3; ++K)
                                  sum += inverse(X, I) * inverse(Y, K) * modulus(3 * a + I, 3 * b + K);
                              EXPECT_NEAR(c[(3 * a + b) * 9 + 3 * X + Y][lane], 1 + share * JxW * sum, 1e-11 * (1 + scale));
                            }
                  }
              }
        }
    }

    TEST(LawKernels, AreDescribedAndRead)
    {
      for (const LawKind &kind : law_kinds())
        {
          SCOPED_TRACE(kind.name);
          const scene::Node node =
              scene::list_of_defaults(laws_schema().named() ? *laws_schema().named() : scene::Schema(), "laws", {"type=" + kind.name});
          EXPECT_EQ(node.text("type"), kind.name);
          EXPECT_EQ(node.number("weight"), 1);
          EXPECT_FALSE(kind.doc.empty());
        }
    }
  } // namespace
} // namespace myolines
