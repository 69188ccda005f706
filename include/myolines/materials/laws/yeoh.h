// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/isotropic_law.h>

namespace myolines
{
  /// Yeoh (1993): Psi = sum_k c_k (I1 - 3)^k, k = 1, 2, 3, of the isochoric invariant; a neo-Hookean law has c1 alone. P is the type of its
  /// constants, which fields may make vary from point to point.
  template <typename P = double>
  struct Yeoh : IsotropicLaw<Yeoh<P>>
  {
    ///@{
    /// As law.h has it.
    static constexpr const char *name = "yeoh";
    static constexpr const char *doc  = "Isotropic energy sum c_k (I1 - 3)^k; with c1 alone a neo-Hookean law of shear modulus 2 c1.";
    ///@}

    P c[3] = {1e4, 0, 0}; ///< c_1, c_2, c_3 [Pa]

    Yeoh() = default; ///< with the default of the constants
    /// With three @p constants.
    MYOLINES_INLINE explicit Yeoh(const P *constants)
      : c{constants[0], constants[1], constants[2]}
    {}

    /// See law.h.
    template <typename Visit>
    void parameters(const Visit &visit)
    {
      visit(c[0], "c1", "Pa", Bound::any, "Half the shear modulus.");
      visit(c[1], "c2", "Pa", Bound::any, "Of (I1 - 3)^2.");
      visit(c[2], "c3", "Pa", Bound::any, "Of (I1 - 3)^3.");
    }

    /// Psi' and Psi'' at @p I1.
    template <typename T>
    MYOLINES_INLINE IsotropicResponse<T> response(const T &I1) const
    {
      const T x = I1 - T(3.);
      return {c[0] + x * (T(2.) * c[1] + x * T(3.) * c[2]), T(2.) * c[1] + x * T(6.) * c[2]};
    }

    /// Psi [J/m^3]
    template <typename T>
    T energy_of(const T &I1) const
    {
      const T x = I1 - T(3.);
      return x * (c[0] + x * (c[1] + x * c[2]));
    }
  };
} // namespace myolines
