// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/particles/particle_system.h>
#include <myolines/system/drive.h>
#include <myolines/system/ledger.h>

#include <memory>

namespace myolines
{
  /// Masses in a row behind a support that moves as s(t), with springs and dampers between neighbours, unknown 0 the support:
  ///
  ///     m_i u_i'' + f_i - f_(i+1) = 0,   f_i = k_i (u_i - u_(i-1)) + c_i (u_i' - u_(i-1)'),   u_0 = s(t),   i = 1 ... n,
  ///
  /// f_(n+1) = 0. With k_1 = 1e7 N/m, k_2 = 1 N/m, masses of 1 kg and s = sin(1.2 t) the model problem of Bathe and Noh
  /// (doi:10.1016/j.compstruc.2012.01.009): a stiff spring stands for what nobody wants to resolve.
  struct MassChainParameters
  {
    std::vector<double>          masses{1, 1};        ///< m_i [kg]
    std::vector<double>          stiffnesses{1e7, 1}; ///< k_i [N/m], as many
    std::vector<double>          dampings{0, 0};      ///< c_i [N s/m], as many
    double                       support_mass = 0;    ///< that moves with the support [kg]
    std::shared_ptr<const Drive> support;             ///< s [m]
  };

  scene::Schema mass_chain_schema(); ///< Declaration of the list `system` of a mass chain.
  /// Reads that list. @throws InputError for lists of different lengths and masses that are not positive.
  MassChainParameters read_mass_chain(const scene::Node &system);

  /// The chain, from rest at u = 0. The row of the support is the force that moves it.
  class MassChain : public ParticleSystem
  {
  public:
    MassChain(MassChainParameters parameters, WorkLedger &ledger); ///< One rank computes it.

    Capabilities                   capabilities() const override;
    std::size_t                    n_unknowns() const override { return layout_.size(); }
    State                          initial_state(double t0) const override;
    const Constraints             &constraints() const override { return constraints_; }
    void                           prescribed(double t, Side side, State &state) const override;
    Evaluation                     residual(const Point &point, Vector &r) const override;
    std::unique_ptr<Linearisation> make_linearisation() const override;
    void                           linearise(const Point &point, Linearisation &linearisation) const override;
    Energetics                     energetics(const State &state, Side side) const override;
    std::vector<double>            events(double t0, double t1) const override { return parameters_.support->kinks(t0, t1); }
    std::vector<std::string>       names() const override;

  private:
    unsigned int size() const { return parameters_.masses.size(); }
    double       mass(const unsigned int i) const { return i == 0 ? parameters_.support_mass : parameters_.masses[i - 1]; }

    MassChainParameters parameters_;
    WorkLedger         &ledger_;
    Constraints         constraints_;
    Vector              layout_;
  };
} // namespace myolines
