// SPDX-License-Identifier: LGPL-2.1-or-later
// Tangents of laws by hand and by dual numbers, nanoseconds for a point and cell: `build/release/tests/benchmark_laws`. Compiled as the
// kernels are, for the instruction set that MYOLINES_ISA names. Times are of the processor; both ways take turns, and a ratio is the median
// of those of the turns. With --once every function runs once over the points: laws.py counts its instructions.
#include <myolines/materials/law.h>

#include <laws_of_list.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
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

    /// Of several sweeps over the points.
    double nanoseconds(const std::function<void()> &work)
    {
      const auto now = [] {
        timespec time;
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
      };
      const double start = now();
      for (int s = 0; s < sweeps; ++s)
        work();
      return (now() - start) / (sweeps * n_points * T::size);
    }

    double median(std::vector<double> numbers)
    {
      std::sort(numbers.begin(), numbers.end());
      return numbers[numbers.size() / 2];
    }

    /// Medians of the times of two ways, and of their ratio.
    struct Pair
    {
      Pair(const std::function<void()> &by_hand, const std::function<void()> &by_dual)
      {
        std::vector<double> hands, duals, ratios;
        for (int r = 0; r < repeats; ++r)
          {
            hands.push_back(by_hand ? nanoseconds(by_hand) : 0);
            duals.push_back(nanoseconds(by_dual));
            ratios.push_back(duals.back() / hands.back());
          }
        hand  = median(hands);
        dual  = median(duals);
        ratio = median(ratios);
      }

      double hand, dual, ratio;
    };

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

    void print(const Pair &pair, const bool by_hand)
    {
      if (by_hand)
        std::printf(" %.1f | %.1f | %.2f |", pair.hand, pair.dual, pair.ratio);
      else
        std::printf(" | %.1f | |", pair.dual);
    }

    template <class L>
    void row(const L &law, Points &p, const bool once, const char *type)
    {
      const ByDualNumbers<L> dual{law};
      using Work = std::function<void()>;
      Work action, matrix;
      if constexpr (has_hand_tangent<L>)
        {
          action = [&] { actions(law, p); };
          matrix = [&] { all_moduli(law, p); };
        }
      Work stress = [&] { stresses(law, p); }, dual_action = [&] { actions(dual, p); }, dual_matrix = [&] { all_moduli(dual, p); };
      if (once)
        {
          for (const Work *work : {&stress, &action, &dual_action, &matrix, &dual_matrix})
            if (*work)
              (*work)();
          std::printf("%s,%s,%d\n", L::name, type, n_points * T::size);
          return;
        }
      std::printf("| %s | %.1f |", L::name, Pair({}, stress).dual);
      print({action, dual_action}, has_hand_tangent<L>);
      print({matrix, dual_matrix}, has_hand_tangent<L>);
      std::puts("");
    }
  } // namespace
} // namespace myolines

int main(int argc, char **argv)
{
  using namespace myolines;
  const bool once = argc == 2 && std::string(argv[1]) == "--once";
  if (argc > 1 && !once)
    {
      std::fputs("benchmark_laws [--once]\n", stderr);
      return 2;
    }
  Points p;
  if (!once)
    std::puts("| law | stress [ns] | action by hand [ns] | dual [ns] | ratio | moduli by hand [ns] | dual [ns] | ratio "
              "|\n|---|---|---|---|---|---|---|---|");
#define MYOLINES_LAW(file, law) row(law{}, p, once, #law);
#include <myolines/materials/laws/list.def>
#undef MYOLINES_LAW
  return 0;
}
