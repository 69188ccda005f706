// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/law.h>

namespace myolines
{
  /// A Newtonian fluid in parallel with whatever else there is: with the rate of deformation D = sym(F_rate F^(-1)), the Cauchy stress
  ///
  ///     sigma = 2 eta (D - tr(D)/3 I) + zeta tr(D) I.
  struct Viscosity
  {
    ///@{
    /// As law.h has it.
    static constexpr const char *name           = "viscosity";
    static constexpr const char *doc            = "Newtonian viscosity in all directions: sigma = 2 eta dev D + zeta tr(D) I.";
    static constexpr Rates       rates          = Rates::all;
    static constexpr bool        stress_at_rest = false;
    ///@}

    double shear = 10; ///< eta [Pa s]
    double bulk  = 0;  ///< zeta [Pa s]

    /// See law.h.
    template <typename Visit>
    void parameters(const Visit &visit)
    {
      visit(shear, "shear viscosity", "Pa s", Bound::not_negative, "eta; a bar that is stretched at constant volume has 3 eta.");
      visit(bulk, "bulk viscosity", "Pa s", Bound::not_negative, "zeta, against changes of volume.");
    }

    /// P [Pa]
    template <typename T, typename A>
    MYOLINES_INLINE Mat3<T> stress(const Strain<T, A> &s) const
    {
      const Mat3<T> L = s.F_rate * transpose(s.H);
      return s.J * (plus_identity(shear * (L + transpose(L)), (bulk - 2. / 3. * shear) * trace(L)) * s.H);
    }
  };
} // namespace myolines
