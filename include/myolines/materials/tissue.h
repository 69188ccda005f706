#pragma once

#include <myolines/materials/curves.h>

namespace myolines
{
  /// Yeoh energy of an isotropic part: Psi(I1) = scale * sum_k c_k (I1 - 3)^k, I1 the isochoric invariant J^(-2/3) tr C.
  struct YeohParameters
  {
    double scale = 2e5; ///< s sigma0 [Pa]
    double c[3]  = {0.1990559575103343, 0.3662334826469149, 0};
  };

  /// Hill-type fibre: sigma = sigma0 (a sA(lam) sV(e) + sP(lam)), thesis (5.2.5).
  struct FibreParameters
  {
    double sigma0              = 2e5; ///< maximum isometric stress [Pa]
    double maximum_strain_rate = 5;   ///< e0 [1/s]
    bool   force_velocity      = true;
  };

  struct TissueParameters
  {
    double          density      = 1060; ///< rho0 [kg/m^3]
    double          bulk_modulus = 1e7;  ///< kappa [Pa]
    FibreParameters fibre;
    YeohParameters  base;
  };

  /// Fibre stress over stretch, g = sigma_f/lam [Pa], and its derivatives; the model every fibre part reduces to.
  template <typename T>
  struct FibreStress
  {
    T g;
    T g_stretch;     ///< dg/dlam
    T g_strain_rate; ///< dg/de, e the non-dimensional strain rate
  };

  /// Muscle fibre at isochoric stretch @p lam and strain rate @p e; @p activation in [0, 1]. The template parameters say
  /// what a scene needs: without activation no active curve is evaluated, without rate no force-velocity curve.
  template <bool active, bool rate, typename T>
  MYOLINES_INLINE FibreStress<T> muscle_fibre(const FibreParameters &fibre, const T &activation, const T &lam, const T &e)
  {
    const curves::Curve<T> passive = curves::passive(lam);
    T                      stress = passive.value, d_stretch = passive.slope, d_rate(0.);
    if constexpr (active)
      {
        const curves::Curve<T> sA = curves::active(lam);
        if constexpr (rate)
          {
            const curves::Curve<T> sV = curves::force_velocity(e);
            stress += activation * sA.value * sV.value;
            d_stretch += activation * sA.slope * sV.value;
            d_rate = activation * sA.value * sV.slope;
          }
        else
          {
            stress += activation * sA.value;
            d_stretch += activation * sA.slope;
          }
      }
    const T scale = T(fibre.sigma0) / lam;
    return {scale * stress, scale * (d_stretch - stress / lam), scale * d_rate};
  }

  /// First and second derivative of the Yeoh energy with respect to I1 [Pa].
  template <typename T>
  struct YeohDerivatives
  {
    T first;
    T second;
  };
  template <typename T>
  MYOLINES_INLINE YeohDerivatives<T> yeoh(const YeohParameters &base, const T &I1)
  {
    const T x = I1 - T(3.);
    return {T(base.scale) * (T(base.c[0]) + x * (T(2. * base.c[1]) + x * T(3. * base.c[2]))),
            T(base.scale) * (T(2. * base.c[1]) + x * T(6. * base.c[2]))};
  }
} // namespace myolines
