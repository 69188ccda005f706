// SPDX-License-Identifier: LGPL-2.1-or-later
// Every law of laws/list.def is found by this file: what any law must satisfy.
#include "law_states.h"

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    using namespace test;

    /// Difference of fourth order of the stress along a direction.
    template <class L>
    Matrix difference(const L &law, const Deformation<double> &at, const Matrix &dF, const Matrix &dF_rate)
    {
      const double h  = 1e-4;
      const auto   to = [&](const double x) {
        Deformation<double> moved = at;
        moved.F                   = at.F + x * dF;
        moved.F_rate              = at.F_rate + x * dF_rate;
        return stress(law, moved);
      };
      return (1 / (12 * h)) * (8. * (to(h) - to(-h)) - (to(2 * h) - to(-2 * h)));
    }

    /// f(law) for all of the list, with the parameters of its defaults.
    template <typename Function>
    void for_each_law(const Function &f){
#define MYOLINES_LAW(file, law)                                                                                                            \
  {                                                                                                                                        \
    SCOPED_TRACE(law::name);                                                                                                               \
    f(law{});                                                                                                                              \
  }
#include <myolines/materials/laws/list.def>
#undef MYOLINES_LAW
    }

    TEST(Laws, AreObjective)
    {
      for_each_law([](const auto &law) {
        for (const Deformation<double> &at : states())
          {
            const Matrix        Q = turned(0.9), spin = 2. * transpose(turned(0.3)) - 2. * turned(0.3); // skew
            Deformation<double> turning = at;
            turning.F                   = Q * at.F;
            turning.F_rate              = Q * at.F_rate + Q * (spin * at.F);
            const Matrix P              = stress(law, at);
            EXPECT_LE(size(stress(law, turning) - Q * P), 1e-12 * (size(P) + 1e-3));
            const Matrix tau = P * transpose(at.F);
            EXPECT_LE(size(tau - transpose(tau)), 1e-12 * size(tau)) << "the Kirchhoff stress is not symmetric";
          }
      });
    }

    TEST(Laws, KnowNoDirectionButTheFibre)
    {
      for_each_law([](const auto &law) {
        for (const Deformation<double> &at : states())
          {
            const Matrix        Q       = turned(-0.7);
            Deformation<double> turning = at;
            turning.F                   = at.F * transpose(Q);
            turning.F_rate              = at.F_rate * transpose(Q);
            turning.a0                  = Q * at.a0;
            const Matrix P              = stress(law, at);
            EXPECT_LE(size(stress(law, turning) - P * transpose(Q)), 1e-12 * (size(P) + 1e-3));
            turning    = at;
            turning.a0 = -1. * identity() * at.a0; // a fibre has no sense
            EXPECT_LE(size(stress(law, turning) - P), 1e-13 * size(P));
          }
      });
    }

    TEST(Laws, TangentsAreThoseOfDifferences)
    {
      for_each_law([](const auto &law) {
        using L                                    = std::decay_t<decltype(law)>;
        const std::vector<Deformation<double>> all = states();
        for (std::size_t n = 0; n < all.size(); ++n)
          {
            const Matrix dF = all[(n + 1) % all.size()].F_rate, dF_rate = all[(n + 2) % all.size()].F_rate;
            for (const auto &[u, v] : {std::make_pair(1., 0.), std::make_pair(0., 1.), std::make_pair(1., 30.)})
              {
                const Matrix directions[2] = {u * dF, v * dF_rate};
                Matrix       dual;
                dual_tangents<1>(law, all[n], &directions[0], &directions[1], &dual);
                const Matrix expected = difference(law, all[n], directions[0], directions[1]);
                EXPECT_LE(size(dual - expected), 1e-9 * (size(expected) + 1e-3 * size(stress(law, all[n]))));
                EXPECT_LE(size(tangent(law, all[n], directions[0], directions[1]) - dual), 1e-12 * (size(dual) + 1e-3)) << "by hand";
                if (L::rates == Rates::none && u == 0)
                  {
                    EXPECT_EQ(size(dual), 0);
                  }
              }
          }
      });
    }

    TEST(Laws, ModuliAreTangentsOfAllDirections)
    {
      for_each_law([](const auto &law) {
        using L = std::decay_t<decltype(law)>;
        for (const Deformation<double> &at : states())
          {
            double A[9][9];
            moduli(law, at, 1., 20., A);
            double largest = 0;
            for (int j = 0; j < 9; ++j)
              {
                Matrix one       = Matrix::zero();
                one.entry[j]     = 1;
                const Matrix col = tangent(law, at, one, 20. * one);
                for (int i = 0; i < 9; ++i)
                  {
                    largest = std::max(largest, std::abs(col.entry[i]));
                    EXPECT_NEAR(A[i][j], col.entry[i], 1e-12 * (1 + largest));
                  }
              }
            for (int i = 0; i < 9; ++i)
              for (int j = 0; j < i; ++j)
                if (has_energy<L>)
                  {
                    EXPECT_NEAR(A[i][j], A[j][i], 1e-12 * (1 + largest)) << "no energy has these moduli";
                  }
          }
      });
    }

    TEST(Laws, EnergiesAreWorks)
    {
      for_each_law([](const auto &law) {
        using L = std::decay_t<decltype(law)>;
        if constexpr (has_energy<L>)
          {
            Deformation<double> rest = states().front();
            rest.F                   = identity();
            EXPECT_NEAR(law.energy(strain(rest)), 0, 1e-12);
            for (const Deformation<double> &at : states())
              {
                const Matrix dF     = at.F_rate;
                const auto   energy = [&](const double x) {
                  Deformation<double> moved = at;
                  moved.F                   = at.F + x * dF;
                  return law.energy(strain(moved));
                };
                const double h = 1e-4, power = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
                EXPECT_NEAR(dot(stress(law, at), dF), power, 1e-8 * (std::abs(power) + size(stress(law, at)) * size(dF)));
              }
          }
        else
          {
            EXPECT_TRUE(L::rates != Rates::none) << "a law of F alone has an energy";
          }
      });
    }

    TEST(Laws, RestIsFreeOfStressAndRatesDissipate)
    {
      for_each_law([](const auto &law) {
        using L = std::decay_t<decltype(law)>;
        for (const Deformation<double> &at : states())
          {
            Deformation<double> rest = at, still = at;
            rest.F       = turned(0.4);
            rest.F_rate  = Matrix::zero();
            still.F_rate = Matrix::zero();
            EXPECT_EQ(size(stress(law, rest)) > 1e-10, L::stress_at_rest);
            const Matrix of_rate = stress(law, at) - stress(law, still);
            EXPECT_EQ(size(of_rate) > 0, L::rates != Rates::none);
            EXPECT_GE(dot(of_rate, at.F_rate), 0);
            if (L::rates == Rates::all)
              {
                EXPECT_EQ(size(stress(law, still)), 0);
              }
          }
      });
    }

    /// As much of a law as instruction sets and precisions may change.
    template <typename T>
    Deformation<T> in_lanes(const std::vector<Deformation<double>> &all)
    {
      Deformation<T> at;
      for (int lane = 0; lane < n_lanes; ++lane)
        {
          for (int i = 0; i < 9; ++i)
            {
              at.F.entry[i].set(lane, all[lane].F.entry[i]);
              at.F_rate.entry[i].set(lane, all[lane].F_rate.entry[i]);
            }
          for (int i = 0; i < 3; ++i)
            at.a0[i].set(lane, all[lane].a0[i]);
        }
      at.activation = T(0.7);
      return at;
    }

    template <typename Real, class L>
    double error_in(const L &law)
    {
      using T                                    = Lanes<InstructionSet::baseline, Real>;
      const std::vector<Deformation<double>> all = states();
      const Deformation<T>                   at  = in_lanes<T>(all);
      const Mat3<T>                          P = law.stress(strain(at)), dP = tangent(law, at, at.F_rate, at.F_rate);
      double                                 worst = 0;
      for (int lane = 0; lane < n_lanes; ++lane)
        {
          const Matrix expected = stress(law, all[lane]), change = tangent(law, all[lane], all[lane].F_rate, all[lane].F_rate);
          double       error = 0, of_change = 0;
          for (int i = 0; i < 9; ++i)
            {
              error     = std::max(error, std::abs(P.entry[i][lane] - expected.entry[i]));
              of_change = std::max(of_change, std::abs(dP.entry[i][lane] - change.entry[i]));
            }
          worst = std::max({worst, error / size(expected), of_change / size(change)});
        }
      return worst;
    }

    TEST(Laws, AreTheSameInLanesOfBothPrecisions)
    {
      for_each_law([](const auto &law) {
        EXPECT_LE(error_in<double>(law), 1e-13);
        EXPECT_LE(error_in<float>(law), 1e-4); // single: differences from the identity have 1e-6
        EXPECT_GT(error_in<float>(law), 1e-12);
      });
    }
  } // namespace
} // namespace myolines
