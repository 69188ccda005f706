// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/strain.h>

namespace myolines
{
  // A constitutive law is one file in materials/laws and one line in its list.def: a struct that is copied as plain data, with
  //
  //   name, doc                 as scenes and help have them; doc names the source
  //   rates                     whether the stress depends on F_rate
  //   stress_at_rest            true where the stress is not zero at F = I
  //   parameters(visit)         visit(member, "name", "unit", Bound, "sentence") of each member; what the member holds is the default
  //   stress(s)                 its part of the first Piola-Kirchhoff stress P [Pa] at a Strain, whose pressure is not its business
  //   energy(s)                 per reference volume [J/m^3] for any T, zero at rest, with P = d energy / dF; if it has one
  //   tangent(s)                dP by hand, as a function of (dF, dF_rate), where speed is worth it; else dual numbers make it
  //
  // Residuals, actions, element matrices, energies, `myolines point`, parts of forces and stresses and help follow.

  /// Which values a parameter may have.
  enum class Bound
  {
    any,          ///< every finite number
    not_negative, ///< >= 0
    positive      ///< > 0
  };

  /// What the stress depends on.
  enum class Rates
  {
    none, ///< the stress depends on F alone
    some, ///< on F_rate, too
    all   ///< without F_rate there is none
  };

  namespace law_parts
  {
    /// Whether a law has a tangent by hand.
    template <class L, typename T, typename = void>
    struct HasTangent : std::false_type
    {
    };
    template <class L, typename T>
    struct HasTangent<L, T, std::void_t<decltype(std::declval<const L &>().tangent(std::declval<const Strain<T> &>()))>> : std::true_type
    {
    };
    /// Whether a law has an energy.
    template <class L, typename = void>
    struct HasEnergy : std::false_type
    {
    };
    template <class L>
    struct HasEnergy<L, std::void_t<decltype(std::declval<const L &>().energy(std::declval<const Strain<double> &>()))>> : std::true_type
    {
    };
  } // namespace law_parts

  template <class L>
  constexpr bool has_hand_tangent = law_parts::HasTangent<L, double>::value; ///< Whether the struct has `tangent`.
  template <class L>
  constexpr bool has_energy = law_parts::HasEnergy<L>::value; ///< Whether the struct has `energy`.

  /// dP along n directions at once, by dual numbers: dP[k] = dP/dF : dF[k] + dP/dF_rate : dF_rate[k].
  template <int n, class L, typename T>
  MYOLINES_INLINE void dual_tangents(const L &law, const Deformation<T> &at, const Mat3<T> *dF, const Mat3<T> *dF_rate, Mat3<T> *dP)
  {
    using D         = Dual<T, n>;
    const auto with = [](const Mat3<T> &value, const Mat3<T> *slopes) MYOLINES_INLINED {
      Mat3<D> x;
      MYOLINES_UNROLLED for (int i = 0; i < 9; ++i)
      {
        x.entry[i].value                                                  = value.entry[i];
        MYOLINES_UNROLLED for (int k = 0; k < n; ++k) x.entry[i].slope[k] = slopes[k].entry[i];
      }
      return x;
    };
    const Mat3<D> rate = L::rates == Rates::none ? Mat3<D>::zero() : with(at.F_rate, dF_rate);
    const Mat3<D> P    = law.stress(Strain<D, T>(with(at.F, dF), rate, at));
    MYOLINES_UNROLLED for (int k = 0; k < n; ++k) MYOLINES_UNROLLED for (int i = 0; i < 9; ++i) dP[k].entry[i] = P.entry[i].slope[k];
  }

  /// dP along one direction: by hand where the law has it, else by dual numbers.
  template <class L, typename T>
  MYOLINES_INLINE Mat3<T> tangent(const L &law, const Deformation<T> &at, const Mat3<T> &dF, const Mat3<T> &dF_rate)
  {
    if constexpr (has_hand_tangent<L>)
      return law.tangent(strain(at))(dF, dF_rate);
    else
      {
        Mat3<T> dP;
        dual_tangents<1>(law, at, &dF, &dF_rate, &dP);
        return dP;
      }
  }

  /// All moduli at a point, A[3 a + I][3 b + K] = w_u dP_aI/dF_bK + w_v dP_aI/dF_rate_bK; three directions at a time.
  template <class L, typename T>
  MYOLINES_INLINE void moduli(const L &law, const Deformation<T> &at, const T &w_u, const T &w_v, T (&A)[9][9])
  {
    const auto three_by_three = [&](const auto &tangents) MYOLINES_INLINED {
      for (int b = 0; b < 3; ++b)
        {
          Mat3<T> dF[3], dF_rate[3], dP[3];
          for (int K = 0; K < 3; ++K)
            {
              dF[K] = dF_rate[K]          = Mat3<T>::zero();
              dF[K].entry[3 * b + K]      = w_u;
              dF_rate[K].entry[3 * b + K] = w_v;
            }
          tangents(dF, dF_rate, dP);
          for (int K = 0; K < 3; ++K)
            for (int i = 0; i < 9; ++i)
              A[i][3 * b + K] = dP[K].entry[i];
        }
    };
    if constexpr (has_hand_tangent<L>)
      {
        const Strain<T> s  = strain(at);
        const auto      of = law.tangent(s);
        three_by_three([&](const Mat3<T> *dF, const Mat3<T> *dF_rate, Mat3<T> *dP) MYOLINES_INLINED {
          for (int K = 0; K < 3; ++K)
            dP[K] = of(dF[K], dF_rate[K]);
        });
      }
    else
      three_by_three([&](const Mat3<T> *dF, const Mat3<T> *dF_rate, Mat3<T> *dP)
                         MYOLINES_INLINED { dual_tangents<3>(law, at, dF, dF_rate, dP); });
  }
} // namespace myolines
