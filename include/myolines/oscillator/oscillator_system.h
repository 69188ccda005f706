// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/drive.h>
#include <myolines/system/ledger.h>
#include <myolines/system/semi_discrete_system.h>

#include <memory>

namespace myolines
{
  /// Parameters of m u'' + c (u' - s') + k (u - s) + k3 (u - s)^3 = f(t), s(t) the motion of the support.
  struct OscillatorParameters
  {
    double                       mass            = 1; ///< m [kg]
    double                       damping         = 0; ///< c [N s/m]
    double                       stiffness       = 1; ///< k [N/m]
    double                       cubic_stiffness = 0; ///< k3 [N/m^3]
    double                       displacement    = 1; ///< u(0) [m]
    double                       velocity        = 0; ///< u'(0) [m/s]
    std::shared_ptr<const Drive> force;               ///< f [N], nullptr: none
    std::shared_ptr<const Drive> support;             ///< s [m], nullptr: at rest; then unknown 1 is the support
  };

  scene::Schema        oscillator_schema();                        ///< Declaration of the list `system` of an oscillator.
  OscillatorParameters read_oscillator(const scene::Node &system); ///< Reads that list.

  /// One mass on a spring; the smallest system there is. Unknown 0 is the mass; with a moving support unknown 1
  /// is the support, prescribed as u_1 = s(t), and its row of the residual is the force the support exerts.
  /// Split `linear`: everything but the cubic spring is implicit.
  class OscillatorSystem : public SemiDiscreteSystem
  {
  public:
    OscillatorSystem(OscillatorParameters parameters, WorkLedger &ledger); ///< One rank computes it.

    Capabilities                        capabilities() const override;
    std::size_t                         n_unknowns() const override;
    State                               initial_state(double t0) const override;
    const Constraints                  &constraints() const override;
    void                                prescribed(double t, Side side, State &state) const override;
    Evaluation                          residual(const Point &point, Vector &r) const override;
    std::unique_ptr<Linearisation>      make_linearisation() const override;
    void                                linearise(const Point &point, Linearisation &linearisation) const override;
    std::unique_ptr<SemiDiscreteSystem> implicit_part(const std::string &split) const override;
    Energetics                          energetics(const State &state, Side side) const override;
    std::vector<double>                 events(double t0, double t1) const override;

    const OscillatorParameters &parameters() const { return parameters_; } ///< those of the constructor

  private:
    OscillatorParameters parameters_;
    WorkLedger          &ledger_;
    Constraints          constraints_;
    Vector               layout_;
  };
} // namespace myolines
