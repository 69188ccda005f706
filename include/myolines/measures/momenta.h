// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/muscle3d_system.h>

#include <deal.II/base/tensor.h>

namespace myolines
{
  /// Of the whole body in motion.
  struct Momenta
  {
    double               mass = 0;         ///< [kg]
    dealii::Tensor<1, 3> centre;           ///< of mass, deformed [m]
    dealii::Tensor<1, 3> momentum;         ///< int rho v [kg m/s]
    dealii::Tensor<1, 3> angular_momentum; ///< int rho (x - centre) x v, about the centre of mass [kg m^2/s]
  };
  /// Density is per reference volume. Collective.
  Momenta measure_momenta(const Muscle3dSystem &system, const State &state);
} // namespace myolines
