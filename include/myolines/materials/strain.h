// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/curves.h>
#include <myolines/materials/dual.h>
#include <myolines/materials/matrix.h>

namespace myolines
{
  /// What a point of a tissue is under. T is double or Lanes.
  template <typename T>
  struct Deformation
  {
    Mat3<T>                    F;                ///< deformation gradient
    Mat3<T>                    F_rate;           ///< its time derivative [1/s]; zero in quasi-static systems
    Vec3<T>                    a0;               ///< fibre direction at rest, unit
    T                          activation;       ///< in [0, 1]
    const curves::FibreCurves *curves = nullptr; ///< nullptr: those of the thesis
  };

  /// All that laws are functions of, in the letters of the physics page; T is double, Lanes or a Dual of them, C the type without
  /// derivatives. A law takes what it needs, and the compiler drops the rest.
  template <typename T, typename C = T>
  struct Strain
  {
    Mat3<T>                    F;          ///< deformation gradient
    Mat3<T>                    F_rate;     ///< its time derivative [1/s]
    Vec3<C>                    a0;         ///< of the Deformation
    C                          activation; ///< of the Deformation
    const curves::FibreCurves *curves;     ///< of the Deformation
    T                          J;          ///< det F
    Mat3<T>                    H;          ///< F^(-T) = dJ/dF / J
    T                          power;      ///< J^(-2/3)
    T                          I1;         ///< J^(-2/3) tr(F^T F)
    Vec3<T>                    a;          ///< F a0
    T                          square;     ///< 1/|a|^2
    T                          lam;        ///< isochoric stretch J^(-1/3) |a| of the fibre
    Mat3<T>                    N;          ///< d lam/dF / lam = a (x) a0 / |a|^2 - H/3
    T                          growth;     ///< lam-dot / lam = N : F_rate [1/s]

    /// At F = @p gradient and F_rate = @p rate, which may have derivatives; the rest is that of @p at.
    MYOLINES_INLINE Strain(const Mat3<T> &gradient, const Mat3<T> &rate, const Deformation<C> &at)
      : F(gradient)
      , F_rate(rate)
      , a0(at.a0)
      , activation(at.activation)
      , curves(at.curves)
    {
      const Mat3<T> cof = cofactor(F);
      J                 = F(0, 0) * cof(0, 0) + F(0, 1) * cof(0, 1) + F(0, 2) * cof(0, 2);
      H                 = (1. / J) * cof;
      const T root      = 1. / cbrt(J);
      power             = root * root;
      I1                = power * dot(F, F);
      a                 = F * a0;
      const T length    = dot(a, a);
      square            = 1. / length;
      lam               = root * sqrt(length);
      N                 = square * outer(a, a0) - (1. / 3.) * H;
      growth            = dot(N, F_rate);
    }
  };

  /// Without derivatives.
  template <typename T>
  MYOLINES_INLINE Strain<T> strain(const Deformation<T> &at)
  {
    return {at.F, at.F_rate, at};
  }

  /// A curve of the fibres, such as curves::passive, at a stretch or rate that may have derivatives: the slope is that of the curve.
  template <typename Curve, typename T>
  MYOLINES_INLINE T value_of(const Curve &curve, const T &x)
  {
    return curve(x).value;
  }
  /// The same with derivatives.
  template <typename Curve, typename T, int n>
  MYOLINES_INLINE Dual<T, n> value_of(const Curve &curve, const Dual<T, n> &x)
  {
    const curves::Curve<T> at = curve(x.value);
    return Dual<T, n>(at.value, at.slope, x);
  }
} // namespace myolines
