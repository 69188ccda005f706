// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/law.h>

namespace myolines
{
  /// Guccione, McCulloch and Waldman (1991), doi:10.1115/1.2894084: with the isochoric Green strain E = (J^(-2/3) F^T F - I)/2 and its
  /// entries along the fibre f and across it,
  ///
  ///     Psi = C/2 (exp Q - 1),   Q = bf E_ff^2 + bt (E_ss^2 + E_nn^2 + 2 E_sn^2) + 2 bfs (E_fs^2 + E_fn^2).
  ///
  /// Directions s and n across the fibre need not be known: E_fs^2 + E_fn^2 = |E f|^2 - E_ff^2, and the rest of E : E is that of bt.
  struct Guccione
  {
    ///@{
    /// As law.h has it.
    static constexpr const char *name = "guccione";
    static constexpr const char *doc =
        "Exponential law of passive myocardium, stiffer along the fibres, Guccione et al. (1991), isochoric.";
    static constexpr Rates rates          = Rates::none;
    static constexpr bool  stress_at_rest = false;
    ///@}

    double C   = 2e3; ///< [Pa]
    double bf  = 8;   ///< along the fibre
    double bt  = 2;   ///< across it
    double bfs = 4;   ///< shear between both

    /// See law.h.
    template <typename Visit>
    void parameters(const Visit &visit)
    {
      visit(C, "C", "Pa", Bound::not_negative, "Scale of the energy C/2 (exp Q - 1).");
      visit(bf, "bf", "-", Bound::not_negative, "Weight of the strain along the fibre.");
      visit(bt, "bt", "-", Bound::not_negative, "Weight of strains across it.");
      visit(bfs, "bfs", "-", Bound::not_negative, "Weight of the shear between fibre and across.");
    }

    /// E, E f, E_ff and exp Q.
    template <typename T>
    struct Green
    {
      Mat3<T> E;     ///< isochoric Green strain
      Vec3<T> Ef;    ///< its part along the fibre
      T       Eff;   ///< E_ff
      T       exp_Q; ///< exp Q
    };
    /// All of these.
    template <typename T, typename A>
    MYOLINES_INLINE Green<T> green(const Strain<T, A> &s) const
    {
      const Mat3<T> E   = plus_identity((0.5 * s.power) * (transpose(s.F) * s.F), -0.5);
      const Vec3<T> Ef  = E * s.a0;
      const T       Eff = dot(s.a0, Ef), along = Eff * Eff, Ef2 = dot(Ef, Ef);
      return {E, Ef, Eff, exp(bf * along + bt * (dot(E, E) - 2. * Ef2 + along) + 2. * bfs * (Ef2 - along))};
    }

    /// P [Pa]
    template <typename T, typename A>
    MYOLINES_INLINE Mat3<T> stress(const Strain<T, A> &s) const
    {
      const Green<T> g     = green(s);
      const auto     mixed = outer(g.Ef, s.a0);
      const Mat3<T>  S =
          (C * g.exp_Q) * (bt * g.E + ((bf + bt - 2 * bfs) * g.Eff) * outer(s.a0, s.a0) + (bfs - bt) * (mixed + transpose(mixed)));
      const Mat3<T> FS = s.F * S; // S = dPsi/dE
      return s.power * (FS - (1. / 3.) * dot(FS, s.F) * s.H);
    }

    /// Psi [J/m^3]
    template <typename T>
    T energy(const Strain<T> &s) const
    {
      return 0.5 * C * (green(s).exp_Q - 1.);
    }
  };
} // namespace myolines
