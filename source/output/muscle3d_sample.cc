#include <myolines/output/muscle3d_sample.h>

namespace myolines
{
  namespace
  {
    std::vector<Marker> end_markers(const Geometry &body, const unsigned int force_face)
    {
      const auto ends = end_centres(body);
      return {{"x-", ends[0]}, {"x+", ends[1]}, {"force face", face_centre(body, force_face)}};
    }
  } // namespace

  EndPoints::EndPoints(const Muscle3dSystem &system, const unsigned int force_face)
    : probe(system, end_markers(system.parameters().geometry, force_face), "system/geometry")
    , reference_length(system.parameters().geometry.size[0])
  {}

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
        body_ = measure_body(system_, state_, slab_);
      }
    return *body_;
  }

  Powers Muscle3dSample::powers() const
  {
    if (body_)
      return *body_;
    if (!powers_)
      {
        ledger_.count("power measurements");
        powers_ = measure_powers(system_, state_);
      }
    return *powers_;
  }

  const std::vector<Reaction> &Muscle3dSample::reactions() const
  {
    if (!reactions_)
      {
        ledger_.count("reaction measurements");
        reactions_ = measure_reactions(system_, state_);
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
    const auto moved = ends_.probe.displacements(state_);
    return ends_.reference_length + moved[1][0] - moved[0][0];
  }

  double Muscle3dSample::force_face_speed() const
  {
    // The probe interpolates state.u; a velocity is interpolated the same way.
    State rates;
    rates.t = state_.t;
    rates.u = state_.v;
    return ends_.probe.displacements(rates)[2][0];
  }
} // namespace myolines
