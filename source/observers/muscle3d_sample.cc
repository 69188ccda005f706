// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/measures/face_force.h>
#include <myolines/observers/muscle3d_sample.h>

#include <myolines/muscle3d/discretisation.h>

#include <limits>

namespace myolines
{
  EndPoints::EndPoints(const Muscle3dSystem &system, const std::optional<unsigned int> force_face)
  {
    const NodeSpace &space = *system.discretisation().space;
    if (const auto &line = system.line_of_action().line)
      {
        from.emplace(space, line->from);
        to.emplace(space, line->to);
      }
    if (force_face)
      this->force_face.emplace(space, *force_face);
  }

  Muscle3dSample::Muscle3dSample(const Muscle3dSystem &system, const State &state, const Side side, const SlabRule slab,
                                 const EndPoints &ends, WorkLedger &ledger)
    : system_(system)
    , state_(state)
    , side_(side)
    , slab_(slab)
    , ends_(ends)
    , ledger_(ledger)
  {}

  const BodyMeasures &Muscle3dSample::body() const
  {
    if (!body_)
      {
        ledger_.count("body measurements");
        body_ = measure_body(system_, state_, slab_, side_);
      }
    return *body_;
  }

  Powers Muscle3dSample::powers() const
  {
    if (body_)
      return static_cast<const Powers &>(*body_); // of all that is measured, this part
    if (!powers_)
      {
        ledger_.count("power measurements");
        powers_ = measure_powers(system_, state_, side_);
      }
    return *powers_;
  }

  EnergyRates Muscle3dSample::energy_rates() const { return myolines::energy_rates(powers(), reactions()); }

  Energetics Muscle3dSample::energetics() const
  {
    const double now = energy(body());
    return {now, energy_rates()};
  }

  const std::vector<Reaction> &Muscle3dSample::reactions() const
  {
    if (!reactions_)
      {
        ledger_.count("reaction measurements");
        reactions_ = measure_reactions(system_, state_, side_);
      }
    return *reactions_;
  }

  const Parts<dealii::Tensor<1, 3>> &Muscle3dSample::face_force(const unsigned int face) const
  {
    if (forces_.count(face) == 0)
      {
        ledger_.count("face force measurements");
        forces_[face] = interior_point_force(system_, state_, face);
      }
    return forces_[face];
  }

  Activation Muscle3dSample::activation() const { return system_.activation(state_.t, side_); }

  double Muscle3dSample::muscle_length() const
  {
    const auto &line = system_.line_of_action().line;
    if (!line)
      return std::numeric_limits<double>::quiet_NaN();
    return line->length + (ends_.to->of(state_.u) - ends_.from->of(state_.u)) * line->direction;
  }

  double Muscle3dSample::force_face_speed() const
  {
    const auto &line = system_.line_of_action().line;
    if (!line || !ends_.force_face)
      return std::numeric_limits<double>::quiet_NaN();
    return ends_.force_face->of(state_.v) * line->direction;
  }
} // namespace myolines
