// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/law.h>

namespace myolines
{
  /// First and second derivative of an energy Psi(I1) [Pa].
  template <typename T>
  struct IsotropicResponse
  {
    T first;  ///< Psi' [Pa]
    T second; ///< Psi'' [Pa]
  };

  /// Laws Psi(I1) of the isochoric invariant: the file of one has response(I1), and stress and tangent follow,
  ///
  ///     P = Psi' Q,   dP = Psi'' (Q : dF) Q + Psi' dQ,   Q = dI1/dF = 2 J^(-2/3) F - 2/3 I1 H.
  template <class L>
  struct IsotropicLaw
  {
    static constexpr Rates rates          = Rates::none; ///< as law.h has it
    static constexpr bool  stress_at_rest = false;       ///< as Q = 0 at F = I

    /// P [Pa]
    template <typename T, typename C>
    MYOLINES_INLINE Mat3<T> stress(const Strain<T, C> &s) const
    {
      return first(s.I1) * gradient(s);
    }

    /// dP as a function of (dF, dF_rate); @p s is borrowed.
    template <typename T>
    MYOLINES_INLINE auto tangent(const Strain<T> &s) const
    {
      return [&s, psi = law().response(s.I1), Q = gradient(s)](const Mat3<T> &dF, const Mat3<T> &) MYOLINES_INLINED {
        const T       HdF = dot(s.H, dF), QdF = dot(Q, dF);
        const Mat3<T> dQ =
            (2. * s.power) * dF - (4. / 3. * s.power * HdF) * s.F - (2. / 3. * QdF) * s.H + (2. / 3. * s.I1) * (s.H * transpose(dF) * s.H);
        return (psi.second * QdF) * Q + psi.first * dQ;
      };
    }

    /// Psi [J/m^3]
    template <typename T>
    T energy(const Strain<T> &s) const
    {
      return law().energy_of(s.I1);
    }

  private:
    MYOLINES_INLINE const L &law() const { return static_cast<const L &>(*this); }

    template <typename T, typename C>
    static MYOLINES_INLINE Mat3<T> gradient(const Strain<T, C> &s)
    {
      return (2. * s.power) * s.F - (2. / 3. * s.I1) * s.H;
    }

    template <typename T>
    MYOLINES_INLINE T first(const T &I1) const
    {
      return law().response(I1).first;
    }
    template <typename T, int n>
    MYOLINES_INLINE Dual<T, n> first(const Dual<T, n> &I1) const
    {
      const IsotropicResponse<T> psi = law().response(I1.value);
      return Dual<T, n>(psi.first, psi.second, I1);
    }
  };
} // namespace myolines
