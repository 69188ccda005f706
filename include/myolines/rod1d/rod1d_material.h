// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>

#include <cmath>

namespace myolines
{
  /// Stress P of a rod as a function of its stretch l.
  ///
  /// - linear: P = E (l - 1), E = 3 kappa (1 - 2 nu), thesis (4.6.3);
  /// - Neo-Hookean: P = mu l + (lambda log l - mu)/l, thesis (4.7.1) with the coefficient mu that makes P(1) = 0 (errata 16).
  struct RodMaterial
  {
    bool   linear = true; ///< which of the two
    double young  = 0;    ///< E [Pa], linear
    double lambda = 0;    ///< [Pa], Neo-Hookean
    double mu     = 0;    ///< [Pa], Neo-Hookean

    /// As functions of the strain e = l - 1, so that small strains keep their digits.
    bool admissible(const double strain) const { return linear ? std::isfinite(strain) : strain > -1 && std::isfinite(strain); }
    /// P [Pa]
    double stress(const double strain) const
    {
      return linear ? young * strain : (mu * strain * (2 + strain) + lambda * std::log1p(strain)) / (1 + strain);
    }
    /// Energy per reference volume [J/m^3], the integral of P from l = 1.
    double energy(const double strain) const
    {
      const double log_stretch = std::log1p(strain);
      return linear ? young * strain * strain / 2 : mu * strain * (2 + strain) / 2 + log_stretch * (lambda * log_stretch / 2 - mu);
    }
    /// dP/dl
    double tangent(const double strain) const
    {
      const double stretch = 1 + strain;
      return linear ? young : mu + (lambda * (1 - std::log1p(strain)) + mu) / (stretch * stretch);
    }

    static RodMaterial linear_elastic(double bulk_modulus, double poisson_ratio); ///< @p bulk_modulus kappa [Pa]

    /// Lame parameters as the thesis prints and uses them (4.7.2): lambda = kappa nu/((1 - nu)(1 - 2 nu)), mu = kappa/(2 (1 + nu)).
    static RodMaterial neo_hookean_thesis(double bulk_modulus, double poisson_ratio);

    /// Those of elasticity (errata 12): lambda = E nu/((1 + nu)(1 - 2 nu)), mu = E/(2 (1 + nu)), E = 3 kappa (1 - 2 nu).
    static RodMaterial neo_hookean_corrected(double bulk_modulus, double poisson_ratio);
  };

  scene::Schema rod_material_schema();                          ///< Declaration of the list `material`.
  RodMaterial   read_rod_material(const scene::Node &material); ///< Reads that list.
} // namespace myolines
