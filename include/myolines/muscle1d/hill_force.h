// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/hill_curves.h>
#include <myolines/scene/scene.h>

namespace myolines
{
  /// Base material of a muscle that only resists lengthening, thesis (3.3.9), in units of the maximum isometric force:
  ///
  ///     F_NH = r (mu l + (lambda log l - mu)/l) for stretches l >= 1, else 0;   r = kappa/sigma_0.
  struct BaseMaterial
  {
    double fraction = 0; ///< chi_BM in [0, 1)
    double ratio    = 0; ///< r [-]
    double lambda   = 0; ///< [-]
    double mu       = 0; ///< [-]

    /// lambda = nu/((1 - nu)(1 - 2 nu)), mu = 1/(2 (1 + nu)) as (3.3.10) prints them: the thesis' results hold with these only (errata 12).
    static BaseMaterial as_printed(double fraction, double ratio, double poisson_ratio);
    /// Those of elasticity: lambda = E nu/((1 + nu)(1 - 2 nu)), mu = E/(2 (1 + nu)) with E = 3 (1 - 2 nu) in units of kappa.
    static BaseMaterial corrected(double fraction, double ratio, double poisson_ratio);

    hill::Curve force(double stretch) const; ///< F_NH and its slope, without the fraction
  };

  /// Force of a muscle element over its maximum isometric force F_0, thesis (2.2.3) and (3.3.11):
  ///
  ///     f(l, e, a) = (1 - chi) (a F_A(l) F_V(e) + F_P(l) + eta e) + chi F_NH(l)
  ///
  /// with the stretch l, the strain rate e = l'/e_0 and the activation a. eta is zero in the thesis.
  struct HillForce
  {
    double       maximum_strain_rate = 5;    ///< e_0 [1/s]
    double       damping             = 0;    ///< eta [-]
    bool         force_velocity      = true; ///< false: F_V = 1, for what is said of muscles without it
    BaseMaterial base;                       ///< chi and F_NH

    /// The force and its derivatives.
    struct Value
    {
      double force;         ///< f [-]
      double by_stretch;    ///< df/dl
      double by_rate;       ///< df/dl' [s]
      double by_activation; ///< df/da
    };

    /// @p rate: l' [1/s].
    Value operator()(double stretch, double rate, double activation) const;

    /// At rest: f(l, 0, a) with its slope. F_V(0) = 1.
    hill::Curve isometric(double stretch, double activation) const;
  };

  /// The list `base material`: fraction, ratio, Poisson's ratio, Lame parameters.
  scene::Schema base_material_schema();
  BaseMaterial  read_base_material(const scene::Node &system); ///< Reads that list.
} // namespace myolines
