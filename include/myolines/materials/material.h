#pragma once

#include <myolines/materials/curves.h>

namespace myolines
{
  // Stress laws at a point. Plain data and functions of T, double or Lanes: kernels compile them for several instruction sets.

  /// The numbers that decide the stress at a point: every tissue and every mix is a set of them. Fields of lanes.
  enum MaterialValue
  {
    material_direction = 0,  ///< 3: a0
    material_yeoh      = 3,  ///< 3: C_k of the isotropic energy sum C_k (I1 - 3)^k [Pa], all parts by their weights
    material_bulk      = 6,  ///< kappa [Pa]
    material_density   = 7,  ///< rho0 [kg/m^3]
    material_active    = 8,  ///< factor of a sA sV [Pa]
    material_passive   = 9,  ///< factor of sP [Pa]
    material_tendon    = 10, ///< factor of sT [Pa]
    material_slowness  = 11, ///< 1/e0 [s]
    material_fat       = 12, ///< f [-], for the parts of the stress
    material_tissue    = 13, ///< material id of the tissue, for the parts of the stress
    n_material_values  = 14
  };
  /// Terms of the fibre stress that some point of a batch may have.
  struct FibreTerms
  {
    bool   muscle;     ///< passive muscle fibres
    bool   active;     ///< active stress; only with muscle
    bool   rate;       ///< active stress depends on the strain rate
    bool   tendon;     ///< tendon fibres
    double activation; ///< a, in [0, 1]
  };

  /// Fibre stress over stretch, g = sigma_f/lam [Pa], and its derivatives; the model every fibre part reduces to.
  template <typename T>
  struct FibreStress
  {
    T g;
    T g_stretch;     ///< dg/dlam
    T g_strain_rate; ///< dg/de, e the non-dimensional strain rate
  };

  /// Fibres at isochoric stretch @p lam and strain rate @p e. Curves of terms that do not take part are not evaluated.
  template <typename T>
  MYOLINES_INLINE FibreStress<T> fibre_stress(const T *material, const FibreTerms &terms, const T &lam, const T &e)
  {
    T stress(0.), d_stretch(0.), d_rate(0.);
    if (terms.muscle)
      {
        const curves::Curve<T> passive = curves::passive(lam);
        stress                         = material[material_passive] * passive.value;
        d_stretch                      = material[material_passive] * passive.slope;
      }
    if (terms.active)
      {
        const curves::Curve<T> active = curves::active(lam);
        const T                scale  = material[material_active] * T(terms.activation);
        curves::Curve<T>       velocity{T(1.), T(0.)};
        if (terms.rate)
          velocity = curves::force_velocity(e);
        stress += scale * active.value * velocity.value;
        d_stretch += scale * active.slope * velocity.value;
        d_rate = scale * active.value * velocity.slope;
      }
    if (terms.tendon)
      {
        const curves::Curve<T> tendon = curves::tendon(lam);
        stress += material[material_tendon] * tendon.value;
        d_stretch += material[material_tendon] * tendon.slope;
      }
    const T inverse = T(1.) / lam;
    return {inverse * stress, inverse * (d_stretch - inverse * stress), inverse * d_rate};
  }

  /// First and second derivative of the isotropic energy with respect to I1 [Pa].
  template <typename T>
  struct YeohDerivatives
  {
    T first;
    T second;
  };
  template <typename T>
  MYOLINES_INLINE YeohDerivatives<T> yeoh(const T *material, const T &I1)
  {
    const T *C = material + material_yeoh;
    const T  x = I1 - T(3.);
    return {C[0] + x * (T(2.) * C[1] + x * T(3.) * C[2]), T(2.) * C[1] + x * T(6.) * C[2]};
  }
} // namespace myolines
