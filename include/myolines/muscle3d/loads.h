// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/discretisation.h>
#include <myolines/muscle3d/formula.h>
#include <myolines/system/point.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// What the outside does to the muscle: prescribed motions, tractions and body force, evaluated at nodes and points.
  class Loads
  {
  public:
    Loads(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation);

    /// Sets u, v, a of prescribed components (ghosts included) to the motion of their boundary conditions.
    void prescribe(double t, Side side, State &state) const;

    /// r -= F_ext(t): tractions, isotonic loads, spread evenly over their faces, and body force.
    /// Their l2 norm.
    double subtract_external(double t, Side side, Vector &r) const;
    bool   any_external() const { return body_force_ != nullptr || !tractions_.empty(); }

    /// Power of the tractions and of the body force at velocity @p v on this rank [W].
    double traction_power(double t, Side side, const Vector &v) const; ///< of pressures and of isotonic loads too
    double body_force_power(double t, const Vector &v) const;

  private:
    struct Motion
    {
      const BoundaryCondition                     *condition;
      std::vector<dealii::types::global_dof_index> nodes;
      std::vector<VectorFormula>                   formulas; ///< displacement, velocity, acceleration; or empty
    };
    struct Traction
    {
      const BoundaryCondition     *condition;
      std::optional<VectorFormula> formula;  ///< of a traction by formulas
      double                       area = 1; ///< that a given force is spread over [m^2]

      /// Force per reference area at a point of the face.
      dealii::Tensor<1, 3> value(const dealii::Point<3> &x, const dealii::Tensor<1, 3> &normal, double t, double factor) const;
    };

    void add_tractions(double t, Side side, Vector &f) const;
    void add_body_force(double t, Vector &f) const;

    const Muscle3dDiscretisation  &discretisation_;
    std::vector<Motion>            motions_;
    std::vector<Traction>          tractions_;
    std::unique_ptr<VectorFormula> body_force_;
  };
} // namespace myolines
