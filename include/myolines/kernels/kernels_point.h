// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/kernels/kernels.h>

namespace myolines
{
  // Constitutive law at one point, physics page section 1. T is Lanes. Matrices are 9 entries row by row: index 3 a + J
  // with a the current and J the reference direction.

  /// A : B
  template <typename T>
  MYOLINES_INLINE T dot(const T *a, const T *b)
  {
    T s = a[0] * b[0];
    for (int i = 1; i < 9; ++i)
      s += a[i] * b[i];
    return s;
  }

  /// Everything that depends on F alone.
  template <typename T>
  struct Kinematics
  {
    T F[9]; ///< deformation gradient
    T H[9]; ///< F^(-T)
    T J;    ///< det F

    /// Of F = @p gradient, det F not zero.
    MYOLINES_INLINE explicit Kinematics(const T *gradient)
    {
      for (int i = 0; i < 9; ++i)
        F[i] = gradient[i];
      T cofactor[9];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            cofactor[3 * i + j] = F[3 * i1 + j1] * F[3 * i2 + j2] - F[3 * i1 + j2] * F[3 * i2 + j1];
          }
      J               = F[0] * cofactor[0] + F[1] * cofactor[1] + F[2] * cofactor[2];
      const T inverse = T(1.) / J;
      for (int i = 0; i < 9; ++i)
        H[i] = cofactor[i] * inverse;
    }
  };

  /// H X^T H
  template <typename T>
  MYOLINES_INLINE void HXtH(const T *H, const T *X, T *Y)
  {
    T HXt[9];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        HXt[3 * i + j] = H[3 * i] * X[3 * j] + H[3 * i + 1] * X[3 * j + 1] + H[3 * i + 2] * X[3 * j + 2];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        Y[3 * i + j] = HXt[3 * i] * H[j] + HXt[3 * i + 1] * H[3 + j] + HXt[3 * i + 2] * H[6 + j];
  }

  /// Stress and tangent at a point. L is d2lam/dF2, G = lam N = dlam/dF, Q = dI1/dF.
  template <typename T>
  struct PointLaw
  {
    const KernelModel   &model;  ///< what takes part
    const T             *a0;     ///< fibre direction at rest, unit
    const Kinematics<T> &k;      ///< of F
    T                    power;  ///< J^(-2/3)
    T                    I1;     ///< J^(-2/3) tr(F^T F)
    T                    Q[9];   ///< dI1/dF
    T                    a[3];   ///< F a0
    T                    square; ///< 1/|a|^2
    T                    lam;    ///< isochoric stretch
    T                    N[9];   ///< dlam/dF / lam
    T                    speed;  ///< N : F_rate, or 0
    FibreStress<T>       fibre;  ///< sigma_f/lam and its derivatives
    IsotropicResponse<T> base;   ///< derivatives of the Yeoh energy
    T                    p;      ///< p_h

    /// @p F_rate is used only if model.rate.
    MYOLINES_INLINE PointLaw(const KernelModel &m, const FibreTerms &terms, const T *material, const Kinematics<T> &kinematics,
                             const T *F_rate, const T &pressure)
      : model(m)
      , a0(material + material_direction)
      , k(kinematics)
      , p(pressure)
    {
      const T root = T(1.) / cbrt(k.J);
      power        = root * root;
      I1           = power * dot(k.F, k.F);
      for (int i = 0; i < 9; ++i)
        Q[i] = T(2.) * power * k.F[i] - T(2. / 3.) * I1 * k.H[i];
      base = Yeoh<T>(material + material_yeoh).response(I1);

      T length(0.);
      for (int i = 0; i < 3; ++i)
        {
          a[i] = T(0.);
          for (int j = 0; j < 3; ++j)
            a[i] += k.F[3 * i + j] * a0[j];
          length += a[i] * a[i];
        }
      square = T(1.) / length;
      lam    = root * sqrt(length);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          N[3 * i + j] = a[i] * a0[j] * square - T(1. / 3.) * k.H[3 * i + j];

      const T slowness = material[material_slowness];
      speed            = m.rate ? dot(N, F_rate) : T(0.);
      fibre            = fibre_stress(material, terms, lam, m.rate ? lam * speed * slowness : T(0.));
      fibre.g_strain_rate *= slowness; // per unit of lam-dot from here on
    }

    /// First Piola-Kirchhoff stress P = p J H + psi1 Q + g G.
    MYOLINES_INLINE void stress(T *P) const
    {
      for (int i = 0; i < 9; ++i)
        P[i] = p * k.J * k.H[i] + base.first * Q[i] + fibre.g * lam * N[i];
    }

    /// L : X
    MYOLINES_INLINE void curvature(const T *X, T *Y) const
    {
      const T NX = dot(N, X);
      T       Xa[3], aXa(0.), HX[9]; // Xa = X a0
      for (int i = 0; i < 3; ++i)
        {
          Xa[i] = T(0.);
          for (int j = 0; j < 3; ++j)
            Xa[i] += X[3 * i + j] * a0[j];
          aXa += a[i] * Xa[i];
        }
      HXtH(k.H, X, HX);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          Y[3 * i + j] =
              lam * (N[3 * i + j] * NX + (square * Xa[i] - T(2.) * square * square * aXa * a[i]) * a0[j] + T(1. / 3.) * HX[3 * i + j]);
    }

    /// The fields of TangentValue, with JxW = @p weight.
    MYOLINES_INLINE void store(const T *F_rate, const T &weight, T *tangent) const
    {
      tangent[tangent_p]       = p * k.J * weight;
      tangent[tangent_psi1]    = base.first * weight;
      tangent[tangent_psi2]    = base.second * weight;
      tangent[tangent_power]   = power;
      tangent[tangent_g]       = fibre.g * lam * weight;
      tangent[tangent_stretch] = fibre.g_stretch * lam * lam * weight;
      if (!model.rate)
        return;
      const RateTangent &of       = model.rate_tangent;
      const T            per_rate = fibre.g_strain_rate * lam * weight;
      tangent[tangent_C]          = T(of.by_velocity) * per_rate * lam;
      tangent[tangent_stretch] += T(of.by_stretch) * per_rate * lam * speed;
      T LF[9];
      curvature(F_rate, LF);
      for (int i = 0; i < 9; ++i)
        tangent[tangent_rate + i] = T(of.by_gradient) * per_rate * LF[i];
    }

    /// The tangent without its volumetric rank (dp) as 81 coefficients in unit-cell directions, times @p weight:
    /// c[(3 a + b) * stride9 + (3 A + B) * stride] for node directions A, B and components a, b. @p inverse is
    /// dxi_A/dX_J at 3 A + J.
    MYOLINES_INLINE void coefficients(const T *inverse, const T *LF, const double w_u, const double w_v, const T &weight, T *c,
                                      const int stride9, const int stride) const
    {
      T h[9], q[9], n[9], l[9], along_unit[3], metric[9];
      pull(inverse, k.H, h);
      pull(inverse, Q, q);
      pull(inverse, N, n);
      if (model.rate)
        pull(inverse, LF, l);
      for (int A = 0; A < 3; ++A)
        {
          along_unit[A] = inverse[3 * A] * a0[0] + inverse[3 * A + 1] * a0[1] + inverse[3 * A + 2] * a0[2];
          for (int B = 0; B < 3; ++B)
            metric[3 * A + B] =
                inverse[3 * A] * inverse[3 * B] + inverse[3 * A + 1] * inverse[3 * B + 1] + inverse[3 * A + 2] * inverse[3 * B + 2];
        }

      const T wu = T(w_u) * weight, psi1 = base.first * wu, psi2 = base.second * wu, g = fibre.g * lam * wu, pJ = p * k.J * wu;
      T       nn = fibre.g_stretch * lam * lam * wu + g;
      T       nl(0.); // factor of N (x) L:F_rate
      if (model.rate)
        {
          const RateTangent &of = model.rate_tangent;
          nn += (T(of.by_velocity * w_v) * weight + T(of.by_stretch) * wu * speed) * fibre.g_strain_rate * lam * lam;
          nl = fibre.g_strain_rate * lam * wu * T(model.exact_tangent ? of.by_gradient : 0.5);
        }
      const T hh = pJ - T(4. / 9.) * psi1 * I1, hq = T(-2. / 3.) * psi1, cross = T(2. / 3.) * psi1 * I1 + T(1. / 3.) * g - pJ;
      T       right[3][9]; // partners of h, q and n
      for (int i = 0; i < 9; ++i)
        {
          right[0][i] = hh * h[i] + hq * q[i];
          right[1][i] = psi2 * q[i] + hq * h[i];
          right[2][i] = nn * n[i];
          if (model.rate)
            right[2][i] += nl * l[i];
        }
      const bool symmetrise = model.rate && !model.exact_tangent;
      const T    diagonal = T(2.) * power * psi1, along = g * square, aa = T(-2.) * g * square * square;
      for (int a_ = 0; a_ < 3; ++a_)
        for (int b_ = 0; b_ < 3; ++b_)
          for (int A = 0; A < 3; ++A)
            for (int B = 0; B < 3; ++B)
              {
                const int i = 3 * a_ + A, j = 3 * b_ + B;
                T         s = h[i] * right[0][j] + q[i] * right[1][j] + n[i] * right[2][j] + cross * h[3 * a_ + B] * h[3 * b_ + A];
                s += aa * a[a_] * a[b_] * along_unit[A] * along_unit[B];
                if (symmetrise)
                  s += nl * l[i] * n[j];
                if (a_ == b_)
                  s += diagonal * metric[3 * A + B] + along * along_unit[A] * along_unit[B];
                c[(3 * a_ + b_) * stride9 + (3 * A + B) * stride] = s;
              }
    }

    /// y_aA = x_aJ dxi_A/dX_J
    static MYOLINES_INLINE void pull(const T *inverse, const T *x, T *y)
    {
      for (int i = 0; i < 3; ++i)
        for (int A = 0; A < 3; ++A)
          y[3 * i + A] = x[3 * i] * inverse[3 * A] + x[3 * i + 1] * inverse[3 * A + 1] + x[3 * i + 2] * inverse[3 * A + 2];
    }
  };

  /// The tangent action at a point from stored fields t (TangentValue), times JxW, without the change of p_h:
  /// dP = w_u dP/dF : dF + w_v dP/dFdot : dF. Gives J H JxW too, from which that change is made; @p JxW is the weight.
  template <typename T>
  MYOLINES_INLINE void tangent_action(const KernelModel &model, const T *material, const Kinematics<T> &k, const T *t, const T *dF,
                                      const T &JxW, const double w_u, const double w_v, T *dP, T *cofactor)
  {
    const T u(w_u), power = t[tangent_power], psi1 = u * t[tangent_psi1], pJ = u * t[tangent_p], g = u * t[tangent_g];
    const T I1 = power * dot(k.F, k.F), HdF = dot(k.H, dF), QdF = T(2.) * power * dot(k.F, dF) - T(2. / 3.) * I1 * HdF;
    const T along_Q = u * t[tangent_psi2] * QdF - T(2. / 3.) * psi1 * HdF;

    const T *a0 = material + material_direction;
    T        a[3], da[3], aa(0.), ada(0.); // F a0, dF a0
    for (int i = 0; i < 3; ++i)
      {
        a[i]  = k.F[3 * i] * a0[0] + k.F[3 * i + 1] * a0[1] + k.F[3 * i + 2] * a0[2];
        da[i] = dF[3 * i] * a0[0] + dF[3 * i + 1] * a0[1] + dF[3 * i + 2] * a0[2];
        aa += a[i] * a[i];
        ada += a[i] * da[i];
      }
    const T square = T(1.) / aa, growth = square * ada, NdF = growth - T(1. / 3.) * HdF; // N = a (x) a0 / |a|^2 - H/3
    T       along_N = (g + u * t[tangent_stretch]) * NdF, along_rate(0.);
    if (model.rate)
      {
        const T rate_dF = dot(t + tangent_rate, dF);
        along_N += T(w_v) * t[tangent_C] * NdF + T(model.exact_tangent ? w_u : 0.5 * w_u) * rate_dF;
        if (!model.exact_tangent)
          along_rate = T(0.5 * w_u) * NdF;
      }

    T HdFtH[9];
    HXtH(k.H, dF, HdFtH);
    const T on_dF = T(2.) * power * psi1, on_F = T(2.) * power * along_Q, on_HdFtH = T(2. / 3.) * psi1 * I1 + T(1. / 3.) * g - pJ;
    const T on_H = pJ * HdF - T(2. / 3.) * I1 * along_Q - T(2. / 3.) * psi1 * QdF - T(4. / 9.) * psi1 * I1 * HdF - T(1. / 3.) * along_N;
    const T on_a = square * (along_N - T(2.) * g * growth), on_da = square * g, volume = k.J * JxW;
    for (int i = 0; i < 3; ++i)
      {
        const T fibre = on_a * a[i] + on_da * da[i];
        for (int j = 0; j < 3; ++j)
          {
            const int c = 3 * i + j;
            dP[c]       = on_dF * dF[c] + on_F * k.F[c] + on_H * k.H[c] + on_HdFtH * HdFtH[c] + fibre * a0[j];
            cofactor[c] = volume * k.H[c];
          }
      }
    if (model.rate && !model.exact_tangent)
      for (int c = 0; c < 9; ++c)
        dP[c] += along_rate * t[tangent_rate + c];
  }
} // namespace myolines
