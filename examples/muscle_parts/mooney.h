// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/law.h>

namespace myolines
{
  /// The part that Mooney (1940), doi:10.1063/1.1712836, adds to a neo-Hookean law: Psi = c2 (I2 - 3), with the second invariant of the
  /// isochoric C = J^(-2/3) F^T F, I2 = (tr(C)^2 - C : C)/2.
  struct Mooney
  {
    static constexpr const char *name           = "mooney";
    static constexpr const char *doc            = "Isotropic energy c2 (I2 - 3), Mooney (1940); shear modulus 2 c2.";
    static constexpr Rates       rates          = Rates::none;
    static constexpr bool        stress_at_rest = false;

    double c2 = 1e4;

    template <typename Visit>
    void parameters(const Visit &visit)
    {
      visit(c2, "c2", "Pa", Bound::not_negative, "Half the shear modulus.");
    }

    template <typename T, typename A>
    MYOLINES_INLINE T second_invariant(const Strain<T, A> &s, const Mat3<T> &C) const
    {
      const T trace = dot(s.F, s.F);
      return 0.5 * (s.power * s.power) * (trace * trace - dot(C, C));
    }

    template <typename T, typename A>
    MYOLINES_INLINE Mat3<T> stress(const Strain<T, A> &s) const
    {
      const Mat3<T> C = transpose(s.F) * s.F;
      return (2. * c2) * ((s.power * s.power) * (dot(s.F, s.F) * s.F - s.F * C) - ((2. / 3.) * second_invariant(s, C)) * s.H);
    }

    template <typename T>
    T energy(const Strain<T> &s) const
    {
      return c2 * (second_invariant(s, transpose(s.F) * s.F) - 3.);
    }
  };
} // namespace myolines
