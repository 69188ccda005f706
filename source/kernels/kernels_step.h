// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/kernels/kernels_point.h>

#include <myolines/materials/matrix.h>

namespace myolines
{
  // Forces of two states at a point: what the laws at one state become between the ends of a step.

  /// A point during a step from F_0 to F_1, with C = F^T F. Stresses S belong to P = F_m S, F_m = (F_0 + F_1)/2, so that
  /// P : (F_1 - F_0) = S : (C_1 - C_0)/2, and moments of the forces vanish as S is symmetric.
  ///
  /// Laws are functions of C alone: the middle is C_m = (C_0 + C_1)/2, that of any U with U^T U = C_m, of which the upper triangular one is
  /// taken, under a rate with 2 sym(U^T rate) = 2 sym(F_m^T F_rate), the rate of C.
  template <typename T>
  struct StepPoint
  {
    Mat3<T> F;       ///< F_1
    Mat3<T> middle;  ///< F_m
    Mat3<T> F_rate;  ///< of the step
    Mat3<T> change;  ///< C_1 - C_0
    Mat3<T> U;       ///< upper triangular
    Mat3<T> inverse; ///< U^-1
    Mat3<T> rate;    ///< of U
    Mat3<T> volume;  ///< V with V : (C_1 - C_0)/2 = J_1 - J_0: the increment of det C is cubic, (cof C_m + cof(C_1 - C_0)/12) : (C_1 - C_0)
    Mat3<T> C_m;
    T       J_sum; ///< J_0 + J_1
    T       J;     ///< J_1

    // What laws add.
    Mat3<T> stored;     ///< S at the middle, of what has an energy W
    Mat3<T> stress;     ///< all of S but the volumetric part
    T       secant;     ///< c of the discrete gradient S + c (C_1 - C_0), c = 2 (W_1 - W_0 - S : (C_1 - C_0)/2)/|C_1 - C_0|^2
    T       square;     ///< |C_1 - C_0|^2
    Mat3<T> whole;      ///< S at the middle, of all
    Mat3<T> difference; ///< S_1 - S_0 of what has an energy
    T       lift; ///< l >= 0 of what dissipates, chi/2 (S_1 - S_0 + l (C_1 - C_0)): its work is not negative, and l = 0 where none need be
    Mat3<T> before; ///< F_0

    /// Below this the formula would divide rounding of W by the change: c = 0, and W is conserved to rounding as the rest is cubic.
    static constexpr double least_square = 1e-9;
    MYOLINES_INLINE auto    has_secant() const { return T(least_square) < square; }

    MYOLINES_INLINE void move(const T *F_0, const T *F_1, const T *rate_of_step)
    {
      before             = Mat3<T>::load(F_0);
      F                  = Mat3<T>::load(F_1);
      middle             = T(0.5) * (before + F);
      const Mat3<T> half = transpose(middle) * (F - before);
      change             = half + transpose(half);
      square             = dot(change, change);
      C_m                = T(0.5) * (transpose(before) * before + transpose(F) * F);
      triangulate();
      F_rate = rate = Mat3<T>::zero();
      if (rate_of_step != nullptr)
        {
          F_rate                = Mat3<T>::load(rate_of_step);
          const Mat3<T> of_half = transpose(middle) * F_rate;
          rate                  = transpose(inverse) * (T(0.5) * (of_half + transpose(of_half)));
        }
      J      = determinant(F);
      J_sum  = J + determinant(before);
      volume = (T(2.) / J_sum) * (cofactor(C_m) + T(1. / 12.) * cofactor(change));
    }

    /// dV for a change @p E of C_1.
    MYOLINES_INLINE Mat3<T> change_of_volume(const Mat3<T> &E) const
    {
      const Mat3<T> cof = cofactor(F);
      const T       dJ  = T(0.5) / J * dot(transpose(cof) * cof, E);
      return (T(2.) / J_sum) * (T(0.5) * mixed(C_m, E) + T(1. / 12.) * mixed(change, E)) - (dJ / J_sum) * volume;
    }

    /// S = F^(-1) P at a state @p F.
    static MYOLINES_INLINE Mat3<T> second_stress(const Mat3<T> &F, const Mat3<T> &P)
    {
      return (T(1.) / determinant(F)) * (transpose(cofactor(F)) * P);
    }

    static MYOLINES_INLINE T determinant(const Mat3<T> &a)
    {
      const Mat3<T> cof = cofactor(a);
      return a(0, 0) * cof(0, 0) + a(0, 1) * cof(0, 1) + a(0, 2) * cof(0, 2);
    }

  private:
    /// U by Cholesky's method, and its inverse by substitution.
    MYOLINES_INLINE void triangulate()
    {
      U             = Mat3<T>::zero();
      inverse       = Mat3<T>::zero();
      U(0, 0)       = sqrt(C_m(0, 0));
      inverse(0, 0) = T(1.) / U(0, 0);
      U(0, 1)       = C_m(0, 1) * inverse(0, 0);
      U(0, 2)       = C_m(0, 2) * inverse(0, 0);
      U(1, 1)       = sqrt(C_m(1, 1) - U(0, 1) * U(0, 1));
      inverse(1, 1) = T(1.) / U(1, 1);
      U(1, 2)       = (C_m(1, 2) - U(0, 1) * U(0, 2)) * inverse(1, 1);
      U(2, 2)       = sqrt(C_m(2, 2) - U(0, 2) * U(0, 2) - U(1, 2) * U(1, 2));
      inverse(2, 2) = T(1.) / U(2, 2);
      inverse(0, 1) = -U(0, 1) * inverse(0, 0) * inverse(1, 1);
      inverse(1, 2) = -U(1, 2) * inverse(1, 1) * inverse(2, 2);
      inverse(0, 2) = -(U(0, 1) * inverse(1, 2) + U(0, 2) * inverse(2, 2)) * inverse(0, 0);
    }

    /// d cof(A) along B
    static MYOLINES_INLINE Mat3<T> mixed(const Mat3<T> &a, const Mat3<T> &b) { return cofactor(a + b) - cofactor(a) - cofactor(b); }
  };

  /// Changes of C that are one unit in one entry, and its mirror image.
  struct SymmetricUnit
  {
    int a, b;

    template <typename T>
    MYOLINES_INLINE Mat3<T> matrix() const
    {
      Mat3<T> E = Mat3<T>::zero();
      E(a, b) = E(b, a) = T(1.);
      return E;
    }
  };
  constexpr SymmetricUnit symmetric_units[] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

  /// A += factor column (x) dC_ab/dF with dC = F^T dF + dF^T F, [9][9] with the rows of P and the columns of dF.
  template <typename T>
  MYOLINES_INLINE void add_along(const SymmetricUnit &unit, const T &factor, const Mat3<T> &F, const Mat3<T> &column, T *A)
  {
    for (int k = 0; k < 3; ++k)
      {
        const T at_a = factor * F(k, unit.b), at_b = factor * F(k, unit.a); // dC_ab/dF_ka and /dF_kb
        for (int i = 0; i < 9; ++i)
          {
            A[9 * i + 3 * k + unit.a] += at_a * column.entry[i];
            A[9 * i + 3 * k + unit.b] += at_b * column.entry[i];
          }
      }
  }
} // namespace myolines
