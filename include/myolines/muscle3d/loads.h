// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/discretisation.h>
#include <myolines/muscle3d/surface_forces.h>
#include <myolines/scene/formula.h>
#include <myolines/system/point.h>

#include <memory>
#include <vector>

namespace myolines
{
  /// What the outside does to the muscle whatever its state: prescribed motions, dead loads and body force.
  class Loads
  {
  public:
    /// Borrows discretisation and surface forces. @throws InputError for formulas that cannot be read.
    Loads(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation, const SurfaceForces &surface);

    /// Sets u, v, a of prescribed components (ghosts included) to the motion of their boundary conditions.
    void prescribe(double t, Side side, State &state) const;

    /// r -= F_ext(t), dead loads and body force. Their l2 norm.
    double subtract_external(double t, Side side, Vector &r) const;
    /// whether there may be a body force or a dead load
    bool any_external() const { return body_force_ != nullptr || surface_.any_loads(); }

    /// Power at velocity @p v [W].
    double load_power(double t, Side side, const Vector &v) const; ///< of dead loads
    double body_force_power(double t, const Vector &v) const;      ///< of the body force

  private:
    struct Motion
    {
      std::shared_ptr<const BoundaryCondition>     condition;
      std::vector<dealii::types::global_dof_index> nodes;
    };

    void add_body_force(double t, Vector &f) const;

    const Muscle3dDiscretisation  &discretisation_;
    const SurfaceForces           &surface_;
    std::vector<Motion>            motions_;
    std::unique_ptr<VectorFormula> body_force_;
  };
} // namespace myolines
