// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/materials/curves.h>

#include <algorithm>
#include <cmath>

namespace myolines::curves
{
  namespace
  {
    /// A quadratic c2 (s - x0)^2 + c1 (s - x0) + c0 that holds from x0 to the next piece.
    struct Piece
    {
      double x0, c2, c1, c0;
    };

    /// Integral of the pieces over s from the first x0 to @p stretch.
    template <std::size_t n>
    double integral_over_stretch(const Piece (&pieces)[n], const double stretch)
    {
      double energy = 0;
      for (std::size_t i = 0; i < n && stretch > pieces[i].x0; ++i)
        {
          const auto [x0, c2, c1, c0] = pieces[i];
          const double x1             = i + 1 < n ? std::min(stretch, pieces[i + 1].x0) : stretch;
          energy += 0.5 * c2 * (x1 * x1 - x0 * x0) + (c1 - 2 * c2 * x0) * (x1 - x0) + (c0 - c1 * x0 + c2 * x0 * x0) * std::log(x1 / x0);
        }
      return energy;
    }

    /// Integral of a user's curve over s from 1 to @p stretch, by Gauss' rule of 8 points between knots.
    double integral_over_stretch(const Pieces &pieces, const double stretch)
    {
      constexpr double x[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
      constexpr double w[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
      const double     low = std::min(1., stretch), high = std::max(1., stretch);
      double           energy = 0, a = low;
      for (int i = 0; i <= pieces.n && a < high; ++i)
        {
          const double b = i == pieces.n ? high : std::min(high, pieces.knots[i]);
          if (!(b > a))
            continue;
          for (int k = 0; k < 4; ++k)
            for (const double side : {-1., 1.})
              {
                const double s = (a + b) / 2 + side * x[k] * (b - a) / 2;
                energy += w[k] * (b - a) / 2 * evaluate(pieces, s).value / s;
              }
          a = b;
        }
      return stretch < 1 ? -energy : energy;
    }
  } // namespace

  double passive_energy(const double stretch, const FibreCurves *user)
  {
    if (user != nullptr && user->passive.n > 0)
      return integral_over_stretch(user->passive, stretch);
    constexpr Piece pieces[] = {
        {1, 2.353845, 0, 0}, {1.25, 3.436357, 1.176922, 0.147115}, {1.5, 0.427408, 2.895101, 0.656118}, {1.65, 0, 3.023323, 1.1}};
    return integral_over_stretch(pieces, stretch);
  }

  double tendon_energy(const double stretch, const FibreCurves *user)
  {
    if (user != nullptr && user->tendon.n > 0)
      return integral_over_stretch(user->tendon, stretch);
    constexpr Piece pieces[] = {{1, 515.882034, 0.01, 0.01},
                                {1.01, 600.590242, 10.327641, 0.061688},
                                {1.02, -9.975322, 22.339446, 0.225024},
                                {1.15, 0, 19.745862, 2.960569}};
    return stretch < 1 ? 0.01 * (stretch - 1) : integral_over_stretch(pieces, stretch);
  }
} // namespace myolines::curves
