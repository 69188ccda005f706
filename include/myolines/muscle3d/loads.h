#pragma once

#include <myolines/muscle3d/discretisation.h>
#include <myolines/muscle3d/formula.h>
#include <myolines/system/point.h>

#include <memory>
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

    /// r -= F_ext(t): tractions and body force.
    void subtract_external(double t, Vector &r) const;
    bool any_external() const { return body_force_ != nullptr || !tractions_.empty(); }

    /// Power of the tractions and of the body force at velocity @p v on this rank [W].
    double traction_power(double t, const Vector &v) const;
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
      unsigned int  face;
      VectorFormula formula;
    };

    void add_tractions(double t, Vector &f) const;
    void add_body_force(double t, Vector &f) const;

    const Muscle3dDiscretisation  &discretisation_;
    std::vector<Motion>            motions_;
    std::vector<Traction>          tractions_;
    std::unique_ptr<VectorFormula> body_force_;
  };
} // namespace myolines
