// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/fibre_law.h>

namespace myolines
{
  /// Fibres of tendon and aponeurosis, thesis (5.3.5): sigma_f = sigma0 sT(lam). P: see Yeoh.
  template <typename P = double>
  struct TendinousFibre : LawOfFibres<TendinousFibre<P>>
  {
    ///@{
    /// As law.h has it; sT(1) = 0.01.
    static constexpr const char *name           = "tendinous fibre";
    static constexpr const char *doc            = "Stress of tendinous fibres, sigma0 sT(lam), thesis (A.2.4) or tissues/curves.";
    static constexpr Rates       rates          = Rates::none;
    static constexpr bool        stress_at_rest = true; ///< sT(1) = 0.01
    ///@}

    P sigma0 = 2e5; ///< [Pa]

    TendinousFibre() = default; ///< with the default of sigma0
    /// With sigma0 = @p scale.
    MYOLINES_INLINE explicit TendinousFibre(const P &scale)
      : sigma0(scale)
    {}

    /// See law.h.
    template <typename Visit>
    void parameters(const Visit &visit)
    {
      visit(sigma0, "stress scale", "Pa", Bound::not_negative, "sigma0 of the fibres.");
    }

    /// sigma_f at lam.
    template <typename T>
    MYOLINES_INLINE FibreResponse<T> of_stretch(const T &lam, const curves::FibreCurves *curves) const
    {
      const curves::Curve<T> sT = curves::tendon(lam, curves);
      return {sigma0 * sT.value, sigma0 * sT.slope, T(0.)};
    }
    /// of_stretch() with the arguments that LawOfFibres has.
    template <typename T, typename S>
    MYOLINES_INLINE FibreResponse<T> response(const T &lam, const T &, const S &s) const
    {
      return of_stretch(lam, s.curves);
    }

    /// sigma0 times the integral of sT/lam from 1 [J/m^3].
    template <typename T>
    MYOLINES_INLINE T energy_of(const T &lam, const curves::FibreCurves *curves) const
    {
      return sigma0 * curves::tendon_energy(lam, curves);
    }
    /// Energy per reference volume [J/m^3].
    template <typename T>
    MYOLINES_INLINE T energy(const Strain<T> &s) const
    {
      return energy_of(s.lam, s.curves);
    }
  };
} // namespace myolines
