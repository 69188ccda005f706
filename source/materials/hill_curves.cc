// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/materials/hill_curves.h>

#include <algorithm>
#include <iterator>

namespace myolines::hill
{
  namespace
  {
    /// c3 s^3 + c2 s^2 + c1 s + c0 with s = x - begin, (A.1.1).
    struct Piece
    {
      double begin, c3, c2, c1, c0;
    };

    constexpr Piece active_pieces[] = {{0.4, 16.259504, 2.735529, 0, 0},
                                       {0.6, -71.836426, 12.491232, 3.045352, 0.239497},
                                       {0.7, 7.352394, -9.059696, 3.388506, 0.597108},
                                       {0.9, 11.676119, -4.648260, 0.646915, 0.971241},
                                       {0.95, 2.669948, -2.896842, 0.269660, 0.993425},
                                       {1.0, 185.407729, -30.069106, 0, 1},
                                       {1.05, 2.958338, -2.257947, -1.616353, 0.948003},
                                       {1.1, 7.333359, -1.814196, -1.819960, 0.861910},
                                       {1.2, 1.162833, 0.385812, -1.962798, 0.669106},
                                       {1.4, 3.773432, 1.083512, -1.668934, 0.301281}};

    constexpr Piece passive_pieces[] = {{0.7, 0.637061, 0.073924, 0.000706, 0},
                                        {1.0, 1.239310, 0.647279, 0.217067, 0.024066},
                                        {1.12, 7.439238, 1.093430, 0.425952, 0.061576},
                                        {1.35, -18.101816, 6.226505, 2.109537, 0.307901},
                                        {1.47, -3.080909, -0.290149, 2.821900, 0.619427}};

    constexpr Piece force_velocity_pieces[] = {{-1.0, 0.220624, 0.180895, 0.169799, 0},
                                               {-0.6, 0.809642, 0.445644, 0.420414, 0.110983},
                                               {-0.4, 1.352406, 0.931429, 0.695829, 0.219368},
                                               {-0.3, 5.649771, 1.337151, 0.922687, 0.299618},
                                               {-0.15, 33.819416, 3.879548, 1.705192, 0.487175},
                                               {-0.1, 29.535258, 8.952460, 2.346792, 0.586361},
                                               {-0.05, 508.735536, 13.382749, 3.463553, 0.7297735355},
                                               {0, 143713.368503, -204.615076, 8.745168, 1},
                                               {0.007, -705905.249709, 2813.365662, 27.006422, 1.100484},
                                               {0.01, 234818.856704, -3539.781585, 24.827174, 1.187764},
                                               {0.015, -14695.733995, -17.498735, 7.040773, 1.252758},
                                               {0.02, 6806.732497, -237.934745, 5.763605, 1.285687},
                                               {0.03, 117.239184, -33.732770, 3.046930, 1.326336},
                                               {0.04, 257.061419, -30.215594, 2.407447, 1.353550},
                                               {0.07, 26.551643, -7.080067, 1.288577, 1.405520},
                                               {0.12, 8.331011, -3.097320, 0.779708, 1.455567},
                                               {0.2, 1.699155, -1.097878, 0.444092, 1.502386},
                                               {0.3, 0.842130, -0.588131, 0.275491, 1.537516},
                                               {0.4, 0.299331, -0.335492, 0.183129, 1.560026},
                                               {0.6, 0.083998, -0.155894, 0.084851, 1.585627}};

    constexpr Piece tendon_pieces[] = {{0, 0, 0, 0.009717, 0},
                                       {1.00472, -32632.569799, 961.712634, 5.666232, 0.009763},
                                       {1.01, -12072.697295, 444.812728, 13.092686, 0.061688},
                                       {1.02, -770.792801, 82.631809, 18.367131, 0.225024},
                                       {1.058, 0, 0, 21.308074, 1}};

    Curve at(const Piece &p, const double x)
    {
      const double s = x - p.begin;
      return {((p.c3 * s + p.c2) * s + p.c1) * s + p.c0, (3 * p.c3 * s + 2 * p.c2) * s + p.c1};
    }

    /// Of the last piece that begins at @p x or before; 0 before the first.
    template <std::size_t n>
    Curve evaluate(const Piece (&pieces)[n], const double x)
    {
      const Piece *next = std::upper_bound(std::begin(pieces), std::end(pieces), x, [](double y, const Piece &p) { return y < p.begin; });
      return next == std::begin(pieces) ? Curve{0, 0} : at(next[-1], x);
    }
  } // namespace

  Curve active(const double stretch) { return stretch > 1.7 ? Curve{0, 0} : evaluate(active_pieces, stretch); }

  Curve passive(const double stretch)
  {
    if (stretch <= 1.65)
      return evaluate(passive_pieces, stretch);
    const Curve end = evaluate(passive_pieces, 1.65);
    return {end.value + end.slope * (stretch - 1.65), end.slope};
  }

  Curve force_velocity(const double rate)
  {
    return rate <= 1 ? evaluate(force_velocity_pieces, rate) : Curve{evaluate(force_velocity_pieces, 1).value, 0};
  }

  Curve tendon(const double stretch) { return evaluate(tendon_pieces, stretch); }

  double tendon_energy(const double stretch)
  {
    const auto from_zero = [](const double x) {
      double sum = 0;
      for (auto p = std::begin(tendon_pieces); p != std::end(tendon_pieces) && p->begin < x; ++p)
        {
          const double s = (std::next(p) == std::end(tendon_pieces) ? x : std::min(x, std::next(p)->begin)) - p->begin;
          sum += (((p->c3 / 4 * s + p->c2 / 3) * s + p->c1 / 2) * s + p->c0) * s;
        }
      return sum;
    };
    return from_zero(stretch) - from_zero(1);
  }
} // namespace myolines::hill
