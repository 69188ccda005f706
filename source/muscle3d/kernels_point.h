#pragma once

#include <myolines/muscle3d/kernels.h>

namespace myolines
{
  // Constitutive law at one point, physics page section 1. T is Lanes. Matrices are 9 entries row by row: index 3 a + J
  // with a the current and J the reference direction.

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
    T F[9];
    T H[9]; ///< F^(-T)
    T J;    ///< det F

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

  /// Stress and tangent at a point. L is d2lam/dF2, G = lam N = dlam/dF, Q = dI1/dF.
  template <typename T>
  struct PointLaw
  {
    const KernelModel   &model;
    const Kinematics<T> &k;
    T                    power; ///< J^(-2/3)
    T                    I1;
    T                    Q[9];
    T                    a[3];   ///< F a0
    T                    square; ///< 1/|a|^2
    T                    lam;    ///< isochoric stretch
    T                    N[9];   ///< dlam/dF / lam
    FibreStress<T>       fibre;
    YeohDerivatives<T>   base;
    T                    p; ///< p_h

    /// @p F_rate is used only if model.rate.
    MYOLINES_INLINE PointLaw(const KernelModel &m, const Kinematics<T> &kinematics, const T *F_rate, const T &pressure)
      : model(m)
      , k(kinematics)
      , p(pressure)
    {
      const T root = T(1.) / cbrt(k.J);
      power        = root * root;
      I1           = power * dot(k.F, k.F);
      for (int i = 0; i < 9; ++i)
        Q[i] = T(2.) * power * k.F[i] - T(2. / 3.) * I1 * k.H[i];
      base = yeoh(m.tissue.base, I1);

      T length(0.);
      for (int i = 0; i < 3; ++i)
        {
          a[i] = T(0.);
          for (int j = 0; j < 3; ++j)
            a[i] += k.F[3 * i + j] * T(m.fibre_direction[j]);
          length += a[i] * a[i];
        }
      square = T(1.) / length;
      lam    = root * sqrt(length);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          N[3 * i + j] = a[i] * T(m.fibre_direction[j]) * square - T(1. / 3.) * k.H[3 * i + j];

      const T activation(m.activation);
      if (!m.active)
        fibre = muscle_fibre<false, false>(m.tissue.fibre, activation, lam, T(0.));
      else if (!m.rate)
        fibre = muscle_fibre<true, false>(m.tissue.fibre, activation, lam, T(0.));
      else
        {
          fibre =
              muscle_fibre<true, true>(m.tissue.fibre, activation, lam, lam * dot(N, F_rate) * T(1. / m.tissue.fibre.maximum_strain_rate));
          fibre.g_strain_rate *= T(1. / m.tissue.fibre.maximum_strain_rate); // per unit of lam-dot from here on
        }
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
            Xa[i] += X[3 * i + j] * T(model.fibre_direction[j]);
          aXa += a[i] * Xa[i];
        }
      HXtH(X, HX);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          Y[3 * i + j] = lam * (N[3 * i + j] * NX + (square * Xa[i] - T(2.) * square * square * aXa * a[i]) * T(model.fibre_direction[j]) +
                                T(1. / 3.) * HX[3 * i + j]);
    }

    /// H X^T H
    MYOLINES_INLINE void HXtH(const T *X, T *Y) const
    {
      T HXt[9];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          HXt[3 * i + j] = k.H[3 * i] * X[3 * j] + k.H[3 * i + 1] * X[3 * j + 1] + k.H[3 * i + 2] * X[3 * j + 2];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          Y[3 * i + j] = HXt[3 * i] * k.H[j] + HXt[3 * i + 1] * k.H[3 + j] + HXt[3 * i + 2] * k.H[6 + j];
    }

    /// dP for dF with weights of K and C; dp is the change of p_h (with the weight of K in it). @p LF = L : F_rate, used
    /// only if model.rate.
    MYOLINES_INLINE void tangent(const T *dF, const T &dp, const T *LF, const double w_u, const double w_v, T *dP) const
    {
      const T HdF = dot(k.H, dF), QdF = dot(Q, dF), NdF = lam * dot(N, dF);
      T       Hd[9], Ld[9];
      HXtH(dF, Hd);
      curvature(dF, Ld);
      T along = T(w_u) * fibre.g_stretch * NdF; // factor of G
      if (model.rate)
        {
          along += T(w_v) * fibre.g_strain_rate * NdF;
          along += T(model.exact_tangent ? w_u : 0.5 * w_u) * fibre.g_strain_rate * dot(LF, dF);
        }
      const T across = model.rate && !model.exact_tangent ? T(0.5 * w_u) * fibre.g_strain_rate * NdF : T(0.);
      const T u(w_u);
      for (int i = 0; i < 9; ++i)
        {
          const T volumetric = k.J * (dp * k.H[i] + u * p * (HdF * k.H[i] - Hd[i]));
          const T isotropic  = base.second * Q[i] * QdF + base.first * (T(2.) * power * dF[i] - T(2. / 3.) * (Q[i] * HdF + k.H[i] * QdF) -
                                                                       T(4. / 9.) * I1 * k.H[i] * HdF + T(2. / 3.) * I1 * Hd[i]);
          dP[i]              = volumetric + u * (isotropic + fibre.g * Ld[i]) + along * lam * N[i];
          if (model.rate && !model.exact_tangent)
            dP[i] += across * LF[i];
        }
    }

    /// The tangent without its volumetric rank (dp) as 81 coefficients in unit-cell directions, times @p weight:
    /// c[(3 a + b) * stride9 + (3 A + B) * stride] for node directions A, B and components a, b. @p inverse is
    /// dxi_A/dX_J at 3 A + J.
    MYOLINES_INLINE void coefficients(const T *inverse, const T *LF, const double w_u, const double w_v, const T &weight, T *c,
                                      const int stride9, const int stride) const
    {
      T h[9], q[9], n[9], l[9], a0[3], metric[9];
      pull(inverse, k.H, h);
      pull(inverse, Q, q);
      pull(inverse, N, n);
      if (model.rate)
        pull(inverse, LF, l);
      for (int A = 0; A < 3; ++A)
        {
          a0[A] = inverse[3 * A] * T(model.fibre_direction[0]) + inverse[3 * A + 1] * T(model.fibre_direction[1]) +
                  inverse[3 * A + 2] * T(model.fibre_direction[2]);
          for (int B = 0; B < 3; ++B)
            metric[3 * A + B] =
                inverse[3 * A] * inverse[3 * B] + inverse[3 * A + 1] * inverse[3 * B + 1] + inverse[3 * A + 2] * inverse[3 * B + 2];
        }

      const T wu = T(w_u) * weight, psi1 = base.first * wu, psi2 = base.second * wu, g = fibre.g * lam * wu, pJ = p * k.J * wu;
      T       nn = fibre.g_stretch * lam * lam * wu + g;
      T       nl(0.); // factor of N (x) L:F_rate
      if (model.rate)
        {
          nn += T(w_v) * weight * fibre.g_strain_rate * lam * lam;
          nl = fibre.g_strain_rate * lam * wu * T(model.exact_tangent ? 1. : 0.5);
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
                s += aa * a[a_] * a[b_] * a0[A] * a0[B];
                if (symmetrise)
                  s += nl * l[i] * n[j];
                if (a_ == b_)
                  s += diagonal * metric[3 * A + B] + along * a0[A] * a0[B];
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
} // namespace myolines
