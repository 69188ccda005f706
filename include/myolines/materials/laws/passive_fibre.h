// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/fibre_law.h>

namespace myolines
{
  /// Passive fibres of muscle, thesis (5.2.5): sigma_f = sigma0 sP(lam). P: see Yeoh.
  template <typename P = double>
  struct PassiveFibre : LawOfFibres<PassiveFibre<P>>
  {
    ///@{
    /// As law.h has it.
    static constexpr const char *name           = "passive fibre";
    static constexpr const char *doc            = "Passive stress of muscle fibres, sigma0 sP(lam), thesis appendix A.2 or tissues/curves.";
    static constexpr Rates       rates          = Rates::none;
    static constexpr bool        stress_at_rest = false;
    ///@}

    P sigma0 = 2e5; ///< [Pa]

    PassiveFibre() = default; ///< with the default of sigma0
    /// With sigma0 = @p scale.
    MYOLINES_INLINE explicit PassiveFibre(const P &scale)
      : sigma0(scale)
    {}

    /// See law.h.
    template <typename Visit>
    void parameters(const Visit &visit)
    {
      visit(sigma0, "maximum isometric stress", "Pa", Bound::not_negative, "sigma0 of the fibres.");
    }

    /// sigma_f at lam.
    template <typename T>
    MYOLINES_INLINE FibreResponse<T> of_stretch(const T &lam, const curves::FibreCurves *curves) const
    {
      const curves::Curve<T> sP = curves::passive(lam, curves);
      return {sigma0 * sP.value, sigma0 * sP.slope, T(0.)};
    }
    /// of_stretch() with the arguments that LawOfFibres has.
    template <typename T, typename S>
    MYOLINES_INLINE FibreResponse<T> response(const T &lam, const T &, const S &s) const
    {
      return of_stretch(lam, s.curves);
    }

    /// sigma0 times the integral of sP/lam from 1 [J/m^3].
    template <typename T>
    MYOLINES_INLINE T energy_of(const T &lam, const curves::FibreCurves *curves) const
    {
      return sigma0 * curves::passive_energy(lam, curves);
    }
    /// Energy per reference volume [J/m^3].
    template <typename T>
    MYOLINES_INLINE T energy(const Strain<T> &s) const
    {
      return energy_of(s.lam, s.curves);
    }
  };
} // namespace myolines
