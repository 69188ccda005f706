// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/semi_discrete_system.h>

namespace myolines
{
  /// M a + C v + K u with M, C, K of a system at u = v = 0 at time 0: the implicit part of splits that keep what is linear. It
  /// says nothing of loads, nor of stresses that are there at u = v = 0: as parts of F_E they stay.
  class LinearisedSystem : public SemiDiscreteSystem
  {
  public:
    explicit LinearisedSystem(std::unique_ptr<SemiDiscreteSystem> system); ///< Linearises @p system once. Collective.

    Capabilities                   capabilities() const override { return capabilities_; }
    std::size_t                    n_unknowns() const override { return system_->n_unknowns(); }
    State                          initial_state(double t0) const override { return system_->initial_state(t0); }
    const Constraints             &constraints() const override { return system_->constraints(); }
    void                           prescribed(double t, Side side, State &state) const override { system_->prescribed(t, side, state); }
    Evaluation                     residual(const Point &point, Vector &r) const override;
    std::unique_ptr<Linearisation> make_linearisation() const override { return system_->make_linearisation(); }
    void                           linearise(const Point &point, Linearisation &linearisation) const override;
    std::vector<double>            events(double t0, double t1) const override { return system_->events(t0, t1); }
    std::vector<unsigned int>      canonical_order() const override { return system_->canonical_order(); }

  private:
    std::unique_ptr<SemiDiscreteSystem> system_;
    Capabilities                        capabilities_;
    Vector                              zero_;
    std::unique_ptr<Linearisation>      linearisation_;
    mutable Vector                      product_;
  };
} // namespace myolines
