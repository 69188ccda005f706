// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "simulation.h"

#include <myolines/muscle3d/measurements.h>

namespace myolines::test
{
  using Condition = BoundaryCondition;
  using Type      = Condition::Type;

  inline Condition condition(const Type type, const unsigned int face)
  {
    Condition c;
    c.name       = "face " + std::to_string(face);
    c.type       = type;
    c.face       = face;
    c.components = {{false, false, false}};
    return c;
  }

  inline Condition load(const Type type, const unsigned int face, const double size)
  {
    Condition c = condition(type, face);
    c.load      = size;
    return c;
  }

  inline Condition held(const unsigned int face, const bool x = true, const bool y = true, const bool z = true)
  {
    Condition c  = condition(Type::fixed, face);
    c.components = {{x, y, z}};
    return c;
  }

  /// A passive isotropic bar of 3 x 1 x 1 cm on symmetry planes.
  inline Muscle3dParameters bar(const std::vector<Condition> &more)
  {
    Muscle3dParameters p    = small_block(2, 3, 0);
    p.geometry.cells        = {{2, 1, 1}};
    p.dynamic               = false;
    p.activation            = nullptr;
    p.muscle().fibre.sigma0 = 0;
    p.boundary              = {condition(Type::symmetry, 2), condition(Type::symmetry, 4)};
    p.boundary.insert(p.boundary.end(), more.begin(), more.end());
    return p;
  }

  inline dealii::Tensor<1, 3> displacement(const Simulation &simulation, const dealii::Point<3> &x)
  {
    return MarkerProbe(simulation.system, {{"marker", x}}, "test").displacements(simulation.state)[0];
  }

  const dealii::Point<3> corner(0.03, 0.01, 0.01); ///< of the bar
} // namespace myolines::test
