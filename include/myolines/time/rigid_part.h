// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/solve/free_unknowns.h>
#include <myolines/time/stage.h>

namespace myolines
{
  /// The velocities of a step that conserve momenta: with z = (u_1 - u_0)/dt and P the M-orthogonal projection on the rigid motions of
  /// the velocity z (SemiDiscreteSystem::rigid_motions), what a step has beyond an affine map is
  ///
  ///     b = factor P (z - v_0).
  ///
  /// A correction g = z - (v_0 + v_1)/2 with P g = 0 leaves linear and angular momenta to the forces: int rho g = 0, and int rho g x z = 0
  /// is int rho g x (v_0 + v_1)/2 = 0. A body that turns as a whole has v_1 - v_0 among its rigid motions, whatever the angle.
  class RigidPart : public Stage::Beyond
  {
  public:
    /// @p solver is that of the method; both outlive the object.
    RigidPart(const IntegratorContext &context, StageSolver &solver, double factor);

    /// Of a step of @p dt [s] from @p state, which stays as it is until the step is done.
    void begin(double dt, const State &state);

    void evaluate(const Vector &u, Vector &b) override;

  private:
    /// Appends to motions_ what @p field has M-orthogonal to them, of length one; nothing if that is rounding.
    void add_motion(Vector field);
    void apply_mass(const Vector &x, Vector &y) const;

    const SemiDiscreteSystem &system_;
    StageSolver              &solver_;
    const FreeUnknowns        free_;
    const double              factor_;
    double                    dt_    = 0;
    const State              *state_ = nullptr;
    Vector                    z_, mass_;
    struct Motion
    {
      Vector field, mass; ///< q and M q
    };
    std::vector<Motion> motions_;
  };
} // namespace myolines
