// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/fibre_law.h>

namespace myolines
{
  /// Active fibres of muscle, thesis (5.2.5): sigma_f = sigma0 a sA(lam) sV(lam-dot/e0). P: see Yeoh.
  template <typename P = double>
  struct ActiveFibre : LawOfFibres<ActiveFibre<P>>
  {
    ///@{
    /// As law.h has it.
    static constexpr const char *name  = "active fibre";
    static constexpr const char *doc   = "Active stress of muscle fibres, sigma0 a sA(lam) sV(e), thesis appendix A.2 or tissues/curves.";
    static constexpr Rates       rates = Rates::some;
    static constexpr bool        stress_at_rest = true;
    ///@}

    P sigma0       = 2e5; ///< maximum isometric stress [Pa]
    P maximum_rate = 5;   ///< e0 [1/s]

    /// See law.h.
    template <typename Visit>
    void parameters(const Visit &visit)
    {
      visit(sigma0, "maximum isometric stress", "Pa", Bound::not_negative, "sigma0 of the fibres.");
      visit(maximum_rate, "maximum strain rate", "1/s", Bound::positive, "Maximum unloaded strain rate e0.");
    }

    /// At strain rate e = lam-dot/e0, by_rate being that of e; @p strength is sigma0 a. Without @p rate sV is 1 and not evaluated.
    template <typename T>
    static MYOLINES_INLINE FibreResponse<T> of_rate(const T &strength, const T &lam, const T &e, const bool rate,
                                                    const curves::FibreCurves *curves)
    {
      const curves::Curve<T> sA = curves::active(lam, curves);
      curves::Curve<T>       sV{T(1.), T(0.)};
      if (rate)
        sV = curves::force_velocity(e, curves);
      return {strength * sA.value * sV.value, strength * sA.slope * sV.value, strength * sA.value * sV.slope};
    }
    /// sigma_f at lam and lam-dot [1/s].
    template <typename T, typename S>
    MYOLINES_INLINE FibreResponse<T> response(const T &lam, const T &lam_rate, const S &s) const
    {
      const T          slowness = T(1. / maximum_rate);
      FibreResponse<T> sigma    = of_rate(T(sigma0 * s.activation), lam, T(lam_rate * slowness), true, s.curves);
      sigma.by_rate *= slowness;
      return sigma;
    }
  };
} // namespace myolines
