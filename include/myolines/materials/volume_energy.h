// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/lanes.h>

namespace myolines
{
  /// What the energy of a change of volume is; of all tissues of a body.
  enum class VolumeForm
  {
    thesis,     ///< kappa/4 (D^2 - 2 ln D - 1): Simo and Taylor (1982), doi:10.1002/nme.1620210310, and the thesis
    quadratic,  ///< kappa/2 (D - 1)^2
    logarithmic ///< kappa/2 (ln D)^2: Hencky's; not convex where D > e
  };

  constexpr const char *volume_form_names[] = {"thesis", "quadratic", "logarithmic"}; ///< Of a VolumeForm, as scenes have it.

  /// The volumetric energy Psi_vol of the dilatation D [J/m^3] with its derivatives, and what they are between two states. Psi_vol =
  /// Psi_vol' = 0 and Psi_vol'' = kappa at D = 1. T is double or Lanes.
  ///
  /// Not a law of the list: its stress is the pressure, which is a local unknown.
  template <typename T>
  class VolumeEnergy
  {
  public:
    /// @p kappa: bulk modulus at rest [Pa].
    MYOLINES_INLINE VolumeEnergy(const VolumeForm form, const T &kappa)
      : form_(form)
      , kappa_(kappa)
    {}

    /// Psi_vol [J/m^3]
    MYOLINES_INLINE T energy(const T &D) const
    {
      switch (form_)
        {
        case VolumeForm::quadratic:
          return T(0.5) * kappa_ * (D - T(1.)) * (D - T(1.));
        case VolumeForm::logarithmic:
          return T(0.5) * kappa_ * log(D) * log(D);
        case VolumeForm::thesis:
          break;
        }
      return T(0.25) * kappa_ * (D * D - T(2.) * log(D) - T(1.));
    }

    /// Psi_vol', the pressure [Pa], positive in tension.
    MYOLINES_INLINE T stress(const T &D) const
    {
      switch (form_)
        {
        case VolumeForm::quadratic:
          return kappa_ * (D - T(1.));
        case VolumeForm::logarithmic:
          return kappa_ * log(D) / D;
        case VolumeForm::thesis:
          break;
        }
      return T(0.5) * kappa_ * (D - T(1.) / D);
    }

    /// Psi_vol'' [Pa]
    MYOLINES_INLINE T stiffness(const T &D) const
    {
      switch (form_)
        {
        case VolumeForm::quadratic:
          return kappa_;
        case VolumeForm::logarithmic:
          return kappa_ * (T(1.) - log(D)) / (D * D);
        case VolumeForm::thesis:
          break;
        }
      return T(0.5) * kappa_ * (T(1.) + T(1.) / (D * D));
    }

    /// The pressure of a step.
    struct Secant
    {
      T value; ///< (Psi_vol(D1) - Psi_vol(D0))/(D1 - D0) [Pa]
      T slope; ///< its derivative by D1 [Pa]
    };

    /// Between two dilatations, without cancellation. With s = D0 + D1, y = (D1 - D0)/s and ln(D1/D0) = 2 artanh y = 2 y g(y^2)
    /// the value and its slope are
    ///
    ///     thesis:        kappa/4 (s - 4 g/s),              kappa/4 (1 + 4 g/s^2 - 16 y D0 g'/s^3)
    ///     quadratic:     kappa (s/2 - 1),                  kappa/2
    ///     logarithmic:   kappa (ln D0 + ln D1) g/s,        kappa (g/(D1 s) + (ln D0 + ln D1) (4 y D0 g'/s^3 - g/s^2)).
    MYOLINES_INLINE Secant secant(const T &D0, const T &D1) const
    {
      const T s = D0 + D1;
      if (form_ == VolumeForm::quadratic)
        return {kappa_ * (T(0.5) * s - T(1.)), T(0.5) * kappa_};
      const T inverse = T(1.) / s, y = (D1 - D0) / s;
      const auto [g, slope_of_g] = logarithm_of_ratio(y);
      if (form_ == VolumeForm::logarithmic)
        {
          const T logs = log(D0) + log(D1), change = (T(4.) * y * D0 * slope_of_g * inverse - g) * inverse * inverse;
          return {kappa_ * logs * g * inverse, kappa_ * (g * inverse / D1 + logs * change)};
        }
      return {T(0.25) * kappa_ * (s - T(4.) * g * inverse),
              T(0.25) * kappa_ * (T(1.) + inverse * inverse * (T(4.) * g - T(16.) * y * D0 * slope_of_g * inverse))};
    }

  private:
    struct Series
    {
      T value, slope;
    };

    /// g of z = y^2 with artanh y = y g(z), and dg/dz.
    static MYOLINES_INLINE Series logarithm_of_ratio(const T &y)
    {
      const T z = y * y;
      T       g(1. / 17), slope_of_g(8. / 17); // sum z^k/(2k + 1) and its derivative, by Horner's rule
      for (int k = 7; k >= 1; --k)
        {
          g          = g * z + T(1. / (2 * k + 1));
          slope_of_g = slope_of_g * z + T(double(k) / (2 * k + 1));
        }
      g                = g * z + T(1.);
      const auto small = z < T(0.01);              // the next term of the series is below 1e-19 then
      const T    x     = select(small, T(0.5), y); // artanh x / x where the series is long; anything harmless elsewhere
      const T    far   = T(0.5) * log((T(1.) + x) / (T(1.) - x)) / x;
      return {select(small, g, far), select(small, slope_of_g, T(0.5) * (T(1.) / (T(1.) - x * x) - far) / (x * x))};
    }

    VolumeForm form_;
    T          kappa_;
  };
} // namespace myolines
