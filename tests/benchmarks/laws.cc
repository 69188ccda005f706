// SPDX-License-Identifier: LGPL-2.1-or-later
// Tangents of laws by hand and by dual numbers, nanoseconds for a point and cell: `build/release/tests/benchmark_laws`. Compiled as the
// kernels are, for the instruction set that MYOLINES_ISA names.
#include <myolines/materials/law.h>

#include <laws_of_list.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace myolines
{
  namespace
  {
    using T = Lanes<InstructionSet::MYOLINES_ISA, double, Lanes<InstructionSet::MYOLINES_ISA>::width>; // as law_kernels_impl.h

    /// A law whose tangent by hand is hidden.
    template <class L>
    struct ByDualNumbers
    {
      static constexpr Rates rates = L::rates;
      L                      law;

      template <typename Strain>
      MYOLINES_INLINE auto stress(const Strain &s) const
      {
        return law.stress(s);
      }
    };

    constexpr int n_points = 64, repeats = 15, sweeps = 200;

    struct Points
    {
      Points()
        : at(n_points)
        , dF(n_points)
        , dP(n_points)
      {
        unsigned int seed   = 1;
        const auto   random = [&] { return (seed = seed * 1664525u + 1013904223u) / 4294967296. - 0.5; };
        for (int q = 0; q < n_points; ++q)
          {
            for (int i = 0; i < 9; ++i)
              for (int lane = 0; lane < T::size; ++lane)
                {
                  at[q].F.entry[i].set(lane, 0.1 * random() + (i % 4 == 0 ? 1 : 0));
                  at[q].F_rate.entry[i].set(lane, random());
                  dF[q].entry[i].set(lane, random());
                }
            at[q].a0         = {{T(0.48), T(-0.6), T(0.64)}};
            at[q].activation = T(0.7);
          }
      }

      std::vector<Deformation<T>> at;
      std::vector<Mat3<T>>        dF, dP;
    };

    /// Of the fastest of several sweeps over the points.
    template <typename Work>
    double nanoseconds(const Work &work)
    {
      double best = 1e30;
      for (int r = 0; r < repeats; ++r)
        {
          const auto start = std::chrono::steady_clock::now();
          for (int s = 0; s < sweeps; ++s)
            work();
          const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
          best                                                = std::min(best, time.count() / (sweeps * n_points * T::size));
        }
      return best;
    }

    template <class L>
    __attribute__((noinline)) void actions(const L &law, Points &p)
    {
      for (int q = 0; q < n_points; ++q)
        p.dP[q] = tangent(law, p.at[q], p.dF[q], T(40.) * p.dF[q]);
    }

    template <class L>
    __attribute__((noinline)) void all_moduli(const L &law, Points &p)
    {
      for (int q = 0; q < n_points; ++q)
        {
          T A[9][9];
          moduli(law, p.at[q], T(1.), T(40.), A);
          for (int i = 0; i < 9; ++i)
            {
              T sum = A[i][0];
              for (int j = 1; j < 9; ++j)
                sum += A[i][j];
              p.dP[q].entry[i] = sum;
            }
        }
    }

    template <class L>
    __attribute__((noinline)) void stresses(const L &law, Points &p)
    {
      for (int q = 0; q < n_points; ++q)
        p.dP[q] = law.stress(strain(p.at[q]));
    }

    template <class L>
    void row(const L &law, Points &p)
    {
      const ByDualNumbers<L> dual{law};
      const double           stress = nanoseconds([&] { stresses(law, p); }), action = nanoseconds([&] { actions(dual, p); }),
                   matrix = nanoseconds([&] { all_moduli(dual, p); });
      if constexpr (has_hand_tangent<L>)
        {
          const double by_hand = nanoseconds([&] { actions(law, p); }), matrix_by_hand = nanoseconds([&] { all_moduli(law, p); });
          std::printf("| %s | %.1f | %.1f | %.1f | %.2f | %.1f | %.1f | %.2f |\n", L::name, stress, by_hand, action, action / by_hand,
                      matrix_by_hand, matrix, matrix / matrix_by_hand);
        }
      else
        std::printf("| %s | %.1f | | %.1f | | | %.1f | |\n", L::name, stress, action, matrix);
    }
  } // namespace
} // namespace myolines

int main()
{
  using namespace myolines;
  Points p;
  std::puts("| law | stress [ns] | action by hand [ns] | dual [ns] | ratio | moduli by hand [ns] | dual [ns] | ratio "
            "|\n|---|---|---|---|---|---|---|---|");
#define MYOLINES_LAW(file, law) row(law{}, p);
#include <myolines/materials/laws/list.def>
#undef MYOLINES_LAW
  return 0;
}
