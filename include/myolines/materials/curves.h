// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/sine_cosine.h>

namespace myolines::curves
{
  // Normalised stress curves of skeletal muscle, thesis appendix A.2 (tables A.5 to A.8), with the printed coefficients.
  // T is double or Lanes. Each curve returns its value and its slope; outside the tables the rules are those of
  // (A.2.1)-(A.2.4). They are only piecewise smooth: knots are where slopes jump, listed with each curve.

  /// A curve at a point.
  template <typename T>
  struct Curve
  {
    T value; ///< [-]
    T slope; ///< by the argument
  };

  /// A curve of the user: cubics c0 + c1 x + c2 x^2 + c3 x^3 of x = s - s_i from each of n ascending knots s_i to the next, beyond the last
  /// one too; before the first one its row n holds, with x = s - s_0. Borrowed; see CurveSet.
  struct Pieces
  {
    int           n = 0;       ///< 0: the curve of the thesis holds
    const double *knots;       ///< [n] s_i
    const double (*cubics)[4]; ///< [n + 1]
  };
  /// Curves of the user in place of those of the thesis.
  struct FibreCurves
  {
    Pieces active;         ///< sA
    Pieces passive;        ///< sP
    Pieces force_velocity; ///< sV
    Pieces tendon;         ///< sT
  };

  /// The curve at @p s, any number.
  MYOLINES_INLINE Curve<double> evaluate(const Pieces &pieces, const double &s)
  {
    int low = -1, high = pieces.n; // knots[low] <= s < knots[high]
    while (high - low > 1)
      {
        const int middle                        = (low + high) / 2;
        (s < pieces.knots[middle] ? high : low) = middle;
      }
    const double *c = pieces.cubics[low < 0 ? pieces.n : low];
    const double  x = s - pieces.knots[low < 0 ? 0 : low];
    return {((c[3] * x + c[2]) * x + c[1]) * x + c[0], (3 * c[3] * x + 2 * c[2]) * x + c[1]};
  }
  /// Lane by lane.
  template <typename T>
  MYOLINES_INLINE Curve<T> evaluate(const Pieces &pieces, const T &s)
  {
    Curve<T> result;
    for (int lane = 0; lane < T::size; ++lane)
      {
        const Curve<double> one = evaluate(pieces, double(s[lane]));
        result.value.set(lane, one.value);
        result.slope.set(lane, one.slope);
      }
    return result;
  }

  // Below, @p user may be nullptr: the curve of the thesis.

  /// Active stress against isochoric stretch [-], (A.2.1), Konno: sum of 7 sines on [0.4, 1.75], zero elsewhere.
  /// Jumps by -4.3e-3 at 0.4 and 2.9e-3 at 1.75; 0.994100 at stretch 1.
  template <typename T>
  MYOLINES_INLINE Curve<T> active(const T &stretch, const FibreCurves *user = nullptr)
  {
    if (user != nullptr && user->active.n > 0)
      return evaluate(user->active, stretch);
    constexpr double c[7]   = {0.642587, 0.325980, 0.328204, 0.015389, 0.139240, 0.001802, 0.012561};
    constexpr double a[7]   = {1.290128, 5.308970, 6.744187, 19.823677, 8.038287, 32.237736, 23.117614};
    constexpr double b[7]   = {0.629168, -4.520102, 1.689156, -7.386155, 2.543022, -6.454098, -2.643347};
    const T          within = select(stretch < T(0.4), T(0.4), select(stretch > T(1.75), T(1.75), stretch)); // bounds the arguments
    T                value(0.), slope(0.);
    for (int k = 0; k < 7; ++k)
      {
        const SineCosine<T> at = sine_and_cosine(T(a[k]) * within + T(b[k]));
        value += T(c[k]) * at.sine;
        slope += T(c[k] * a[k]) * at.cosine;
      }
    const auto inside = [&](const T &x) { return select(stretch < T(0.4), T(0.), select(stretch > T(1.75), T(0.), x)); };
    return {inside(value), inside(slope)};
  }

  /// Passive stress against isochoric stretch [-], (A.2.2): zero to 1, quadratics with knots 1, 1.25, 1.5, linear beyond 1.65.
  template <typename T>
  MYOLINES_INLINE Curve<T> passive(const T &stretch, const FibreCurves *user = nullptr)
  {
    if (user != nullptr && user->passive.n > 0)
      return evaluate(user->passive, stretch);
    const T    x0 = select(stretch <= T(1.25), T(1.), select(stretch <= T(1.5), T(1.25), select(stretch <= T(1.65), T(1.5), T(1.65))));
    const auto by_piece = [&](const double p1, const double p2, const double p3, const double p4) {
      return select(stretch <= T(1.), T(0.),
                    select(stretch <= T(1.25), T(p1), select(stretch <= T(1.5), T(p2), select(stretch <= T(1.65), T(p3), T(p4)))));
    };
    const T c2 = by_piece(2.353845, 3.436357, 0.427408, 0.);
    const T c1 = by_piece(0., 1.176922, 2.895101, 3.023323);
    const T c0 = by_piece(0., 0.147115, 0.656118, 1.1);
    const T x  = stretch - x0;
    return {(c2 * x + c1) * x + c0, T(2.) * c2 * x + c1};
  }

  /// Integral of passive(s)/s from 1 to the stretch [-]: stored energy of the passive fibre over sigma0. Continuous.
  double passive_energy(double stretch, const FibreCurves *user = nullptr);
  /// Lane by lane.
  template <typename T>
  MYOLINES_INLINE T passive_energy(const T &stretch, const FibreCurves *user = nullptr)
  {
    return each_lane(stretch, [user](const double s) MYOLINES_INLINED { return passive_energy(s, user); });
  }

  /// Force-velocity factor against strain rate e [-] (negative: shortening), (A.2.3), Ross et al.: zero below -1.2, cubics
  /// with knots -0.25, 0, 0.05, constant 1.595047 above 0.75; slope 6.09 at 0. The constant of the piece that ends at rest is printed as
  /// 0.350355, which makes a jump of 1.7e-7 there: the digits beyond are those of a continuous curve (errata 32).
  template <typename T>
  MYOLINES_INLINE Curve<T> force_velocity(const T &e, const FibreCurves *user = nullptr)
  {
    if (user != nullptr && user->force_velocity.n > 0)
      return evaluate(user->force_velocity, e);
    const auto by_piece = [&](const double p0, const double p1, const double p2, const double p3, const double p4, const double p5) {
      return select(e < T(-1.2), T(p0),
                    select(e <= T(-0.25), T(p1), select(e < T(0.), T(p2), select(e <= T(0.05), T(p3), select(e < T(0.75), T(p4), T(p5))))));
    };
    const T x  = e - by_piece(0., -1.2, -0.25, 0., 0.05, 0.);
    const T c3 = by_piece(0., 0.257927, 29.825565, -3165.684798, 0.688221, 0.);
    const T c2 = by_piece(0., 0.143175, -0.943550, 186.196125, -1.413963, 0.);
    const T c1 = by_piece(0., 0., 0.970369, 6.090887, 0.967864, 0.);
    const T c0 = by_piece(0., 0., 0.350355171875, 1., 1.374324, 1.595047);
    return {((c3 * x + c2) * x + c1) * x + c0, (T(3.) * c3 * x + T(2.) * c2) * x + c1};
  }

  /// Stress of tendon and aponeurosis against isochoric stretch [-], (A.2.4), Dick: 0.01 stretch below 1, quadratics with knots 1, 1.01,
  /// 1.02, linear beyond 1.15. Not zero at rest: 0.01. Slopes are continuous to 3e-7.
  template <typename T>
  MYOLINES_INLINE Curve<T> tendon(const T &stretch, const FibreCurves *user = nullptr)
  {
    if (user != nullptr && user->tendon.n > 0)
      return evaluate(user->tendon, stretch);
    const T    x0       = select(stretch < T(1.), T(0.),
                                 select(stretch < T(1.01), T(1.), select(stretch < T(1.02), T(1.01), select(stretch < T(1.15), T(1.02), T(1.15)))));
    const auto by_piece = [&](const double p0, const double p1, const double p2, const double p3, const double p4) {
      return select(stretch < T(1.), T(p0),
                    select(stretch < T(1.01), T(p1), select(stretch < T(1.02), T(p2), select(stretch < T(1.15), T(p3), T(p4)))));
    };
    const T c2 = by_piece(0., 515.882034, 600.590242, -9.975322, 0.);
    const T c1 = by_piece(0.01, 0.01, 10.327641, 22.339446, 19.745862);
    const T c0 = by_piece(0., 0.01, 0.061688, 0.225024, 2.960569);
    const T x  = stretch - x0;
    return {(c2 * x + c1) * x + c0, T(2.) * c2 * x + c1};
  }

  /// Integral of tendon(s)/s from 1 to the stretch [-]. Continuous.
  double tendon_energy(double stretch, const FibreCurves *user = nullptr);
  /// Lane by lane.
  template <typename T>
  MYOLINES_INLINE T tendon_energy(const T &stretch, const FibreCurves *user = nullptr)
  {
    return each_lane(stretch, [user](const double s) MYOLINES_INLINED { return tendon_energy(s, user); });
  }
} // namespace myolines::curves
