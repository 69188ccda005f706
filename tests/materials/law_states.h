// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/law.h>

#include <laws_of_list.h>

#include <cmath>
#include <random>
#include <vector>

namespace myolines::test
{
  using Matrix = Mat3<double>;

  inline Matrix identity() { return plus_identity(Matrix::zero(), 1.); }

  inline double size(const Matrix &A) { return std::sqrt(dot(A, A)); }

  /// Rotation about a tilted axis.
  inline Matrix turned(const double angle)
  {
    const Vec3<double> n{{1 / std::sqrt(14.), 2 / std::sqrt(14.), 3 / std::sqrt(14.)}};
    const Matrix       cross{{0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0}};
    return std::cos(angle) * identity() + std::sin(angle) * cross + (1 - std::cos(angle)) * outer(n, n);
  }

  /// States of det F from 0.8 to 1.3 and fibre stretches from 0.8 to 1.25, in motion, away from knots of curves.
  inline std::vector<Deformation<double>> states()
  {
    std::mt19937                           generator(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<Deformation<double>>       all;
    for (int n = 0; n < 12; ++n)
      {
        Deformation<double> at;
        for (int i = 0; i < 9; ++i)
          {
            at.F.entry[i]      = 0.12 * uniform(generator) + (i % 4 == 0 ? 1 : 0);
            at.F_rate.entry[i] = 0.3 * uniform(generator);
          }
        at.a0         = {{0.48, -0.6, 0.64}};
        at.activation = 0.7;
        all.push_back(at);
      }
    return all;
  }

  template <class L>
  Matrix stress(const L &law, const Deformation<double> &at)
  {
    return law.stress(strain(at));
  }
} // namespace myolines::test
