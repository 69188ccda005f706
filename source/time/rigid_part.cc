// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/rigid_part.h>

#include <cmath>

namespace myolines
{
  RigidPart::RigidPart(const IntegratorContext &context, StageSolver &solver, const double factor)
    : system_(context.system)
    , solver_(solver)
    , free_(context.system.constraints(), context.make_vector())
    , factor_(factor)
    , z_(context.make_vector())
    , mass_(z_)
  {}

  void RigidPart::begin(const double dt, const State &state)
  {
    dt_    = dt;
    state_ = &state;
    solver_.linearise_mass({state.t, Side::right, state.u, state.v, state.a});
  }

  void RigidPart::evaluate(const Vector &u, Vector &b)
  {
    motions_.clear();
    z_.zero_out_ghost_values();
    combine(z_, {{1 / dt_, &u}, {-1 / dt_, &state_->u}});
    for (Vector &field : system_.rigid_motions(z_))
      add_motion(std::move(field));
    combine(z_, {{1, &z_}, {-1, &state_->v}});
    free_.distribute(z_);
    z_.zero_out_ghost_values();
    b.zero_out_ghost_values();
    b = 0;
    for (const Motion &motion : motions_)
      combine(b, {{1, &b}, {factor_ * (motion.mass * z_), &motion.field}});
  }

  void RigidPart::add_motion(Vector field)
  {
    constexpr double rounding = 1e-12; // of squares
    free_.distribute(field);
    field.zero_out_ghost_values();
    apply_mass(field, mass_);
    const double whole = field * mass_;
    for (int pass = 0; pass < 2; ++pass)
      for (const Motion &motion : motions_)
        {
          const double part = motion.mass * field;
          combine(field, {{1, &field}, {-part, &motion.field}});
          combine(mass_, {{1, &mass_}, {-part, &motion.mass}});
        }
    const double square = field * mass_;
    if (!(square > rounding * whole))
      return;
    field *= 1 / std::sqrt(square);
    mass_ *= 1 / std::sqrt(square);
    motions_.push_back({std::move(field), mass_});
  }

  void RigidPart::apply_mass(const Vector &x, Vector &y) const
  {
    y.zero_out_ghost_values();
    solver_.apply({0, 0, 1}, x, y);
    y.zero_out_ghost_values();
  }
} // namespace myolines
