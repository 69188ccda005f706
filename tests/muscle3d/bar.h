// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "simulation.h"

#include <myolines/measures/marker_probe.h>
#include <myolines/muscle3d/body_measures.h>

namespace myolines::test
{
  /// A passive isotropic bar of 3 x 1 x 1 cm on symmetry planes.
  inline Muscle3dParameters bar(const BoundaryConditions &more)
  {
    Muscle3dParameters p    = small_block(2, 3, 0);
    p.geometry.cells        = {{2, 1, 1}};
    p.dynamic               = false;
    p.activation            = nullptr;
    p.muscle().fibre.sigma0 = 0;
    p.boundary              = {condition("symmetry plane", 2), condition("symmetry plane", 4)};
    p.boundary.insert(p.boundary.end(), more.begin(), more.end());
    return p;
  }

  inline dealii::Tensor<1, 3> displacement(const Simulation &simulation, const dealii::Point<3> &x)
  {
    return MarkerProbe(simulation.system, {{"marker", x}}, "test").displacements(simulation.state)[0];
  }

  const dealii::Point<3> corner(0.03, 0.01, 0.01); ///< of the bar
} // namespace myolines::test
