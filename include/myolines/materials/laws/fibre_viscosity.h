// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/law.h>

namespace myolines
{
  /// A Newtonian dashpot along the fibres, in parallel with whatever else there is: the fibre stress of the isochoric stretch lam is
  ///
  ///     sigma_f = eta lam-dot / lam,   P = sigma_f/lam dlam/dF = eta (N : F_rate) N,   N = (dlam/dF) / lam.
  struct FibreViscosity
  {
    ///@{
    /// As law.h has it.
    static constexpr const char *name = "fibre viscosity";
    static constexpr const char *doc  = "Newtonian viscosity along the fibres: sigma = eta lam-dot/lam of the isochoric fibre stretch lam.";
    static constexpr Rates       rates          = Rates::all;
    static constexpr bool        stress_at_rest = false;
    ///@}

    double viscosity = 100; ///< eta [Pa s]

    /// See law.h.
    template <typename Visit>
    void parameters(const Visit &visit)
    {
      visit(viscosity, "viscosity", "Pa s", Bound::not_negative, "eta.");
    }

    /// P [Pa]
    template <typename T, typename A>
    MYOLINES_INLINE Mat3<T> stress(const Strain<T, A> &s) const
    {
      return (viscosity * s.growth) * s.N;
    }
  };
} // namespace myolines
