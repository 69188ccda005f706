// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/laws/active_fibre.h>
#include <myolines/materials/laws/passive_fibre.h>
#include <myolines/materials/laws/tendinous_fibre.h>
#include <myolines/materials/laws/yeoh.h>

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
    material_region    = 14, ///< number of the region of activation
    n_material_values  = 15  ///< how many there are
  };

  /// Activation of the regions of a body, in [0, 1]; region 0 is all that no other region covers.
  constexpr int max_regions = 16;
  /// The activation of each region at one instant.
  struct Activation
  {
    int    n_regions          = 1;  ///< 1 to max_regions
    double level[max_regions] = {}; ///< of each region

    /// Whether nothing is active.
    bool zero() const
    {
      for (int r = 0; r < n_regions; ++r)
        if (level[r] != 0)
          return false;
      return true;
    }

    /// Of the region of a point, or of those of lanes.
    template <typename T>
    MYOLINES_INLINE T at(const T &region) const
    {
      T a(level[0]);
      for (int r = 1; r < n_regions; ++r)
        a = select(region > T(r - 0.5), T(level[r]), a);
      return a;
    }
  };

  /// Terms of the fibre stress that some point of a batch may have.
  struct FibreTerms
  {
    bool                       muscle;     ///< passive muscle fibres
    bool                       active;     ///< active stress; only with muscle
    bool                       rate;       ///< active stress depends on the strain rate
    bool                       tendon;     ///< tendon fibres
    const Activation          *activation; ///< of the regions
    const curves::FibreCurves *curves;     ///< nullptr: those of the thesis
  };

  /// Fibre stress over stretch, g = sigma_f/lam [Pa], and its derivatives; the model every fibre part reduces to.
  template <typename T>
  struct FibreStress
  {
    T g;             ///< sigma_f/lam
    T g_stretch;     ///< dg/dlam
    T g_strain_rate; ///< dg/de, e the non-dimensional strain rate
  };

  /// Fibres at isochoric stretch @p lam and strain rate @p e. Curves of terms that do not take part are not evaluated.
  template <typename T>
  MYOLINES_INLINE FibreStress<T> fibre_stress(const T *material, const FibreTerms &terms, const T &lam, const T &e)
  {
    T          stress(0.), d_stretch(0.), d_rate(0.);
    const auto add = [&](const FibreResponse<T> &of) {
      stress += of.stress;
      d_stretch += of.by_stretch;
    };
    if (terms.muscle)
      add(PassiveFibre<T>(material[material_passive]).of_stretch(lam, terms.curves));
    if (terms.active)
      {
        const T                strength = material[material_active] * terms.activation->at(material[material_region]);
        const FibreResponse<T> active   = ActiveFibre<T>::of_rate(strength, lam, e, terms.rate, terms.curves);
        add(active);
        d_rate = active.by_rate;
      }
    if (terms.tendon)
      add(TendinousFibre<T>(material[material_tendon]).of_stretch(lam, terms.curves));
    const T inverse = T(1.) / lam;
    return {inverse * stress, inverse * (d_stretch - inverse * stress), inverse * d_rate};
  }
} // namespace myolines
