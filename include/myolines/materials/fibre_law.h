// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/law.h>

namespace myolines
{
  /// Fibre stress sigma_f [Pa] at an isochoric stretch lam and a rate lam-dot, and its derivatives.
  template <typename T>
  struct FibreResponse
  {
    T stress;     ///< sigma_f [Pa]
    T by_stretch; ///< of lam [Pa]
    T by_rate;    ///< of lam-dot [Pa s]
  };

  /// Laws sigma_f(lam, lam-dot) along the fibres: the file of one has response(lam, lam-dot, strain), and stress and tangent follow,
  ///
  ///     P = sigma_f/lam dlam/dF = sigma_f N,   N = a (x) a0 / |a|^2 - H/3.
  template <class L>
  struct LawOfFibres
  {
    /// P [Pa]
    template <typename T>
    MYOLINES_INLINE Mat3<T> stress(const Strain<T> &s) const
    {
      return law().response(s.lam, s.lam * s.growth, s).stress * s.N;
    }
    /// P and its derivatives along n directions.
    template <typename T, int n>
    MYOLINES_INLINE Mat3<Dual<T, n>> stress(const Strain<Dual<T, n>, T> &s) const
    {
      using D                      = Dual<T, n>;
      const D                rate  = s.lam * s.growth;
      const FibreResponse<T> sigma = law().response(s.lam.value, rate.value, s);
      return (D(sigma.stress, sigma.by_stretch, s.lam) + D(T(0.), sigma.by_rate, rate)) * s.N;
    }

    /// dP as a function of (dF, dF_rate); @p s is borrowed.
    template <typename T>
    MYOLINES_INLINE auto tangent(const Strain<T> &s) const
    {
      return [&s, sigma = law().response(s.lam, s.lam * s.growth, s)](const Mat3<T> &dF, const Mat3<T> &dF_rate) MYOLINES_INLINED {
        const Vec3<T> da = dF * s.a0;
        const Mat3<T> dN = s.square * outer(da, s.a0) - (2. * s.square * s.square * dot(s.a, da)) * outer(s.a, s.a0) +
                           (1. / 3.) * (s.H * transpose(dF) * s.H);
        const T dlam   = s.lam * dot(s.N, dF);
        T       change = sigma.by_stretch * dlam;
        if (L::rates != Rates::none)
          change += sigma.by_rate * (dlam * s.growth + s.lam * (dot(dN, s.F_rate) + dot(s.N, dF_rate)));
        return change * s.N + sigma.stress * dN;
      };
    }

  private:
    MYOLINES_INLINE const L &law() const { return static_cast<const L &>(*this); }
  };
} // namespace myolines
