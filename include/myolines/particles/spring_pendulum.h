// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/particles/particle_system.h>
#include <myolines/system/ledger.h>

#include <array>

namespace myolines
{
  /// One mass in a plane on a spring from the origin, of rest length L, under gravity along -y:
  ///
  ///     m x'' + k (r - L) x/r + m g e_y = 0,   r = |x|.
  ///
  /// With a stiff spring the problem on which integrators of nonlinear mechanics fail first (Simo and Gonzalez; Armero and Romero,
  /// doi:10.1016/S0045-7825(00)00256-5): it turns by large angles while it vibrates along itself.
  struct SpringPendulumParameters
  {
    double                mass      = 1;    ///< m [kg]
    double                stiffness = 1e4;  ///< k [N/m]
    double                length    = 1;    ///< L [m]
    double                gravity   = 0;    ///< g [m/s^2]
    std::array<double, 2> position{{1, 0}}; ///< x(0) [m], not the origin
    std::array<double, 2> velocity{{0, 1}}; ///< x'(0) [m/s]
  };

  scene::Schema spring_pendulum_schema(); ///< Declaration of the list `system` of a spring pendulum.
  SpringPendulumParameters
  read_spring_pendulum(const scene::Node &system); ///< Reads that list. @throws InputError for a mass at the origin.

  /// The pendulum; unknowns are the coordinates x and y of the mass. Between two states the spring pulls with
  /// k (r_0 + r_1 - 2 L)/(r_0 + r_1) (x_0 + x_1)/2, which does the work W(r_0) - W(r_1) of W = k/2 (r - L)^2 and has no moment.
  class SpringPendulum : public ParticleSystem
  {
  public:
    SpringPendulum(const SpringPendulumParameters &parameters, WorkLedger &ledger); ///< One rank computes it.

    Capabilities                   capabilities() const override;
    std::size_t                    n_unknowns() const override { return 2; }
    State                          initial_state(double t0) const override;
    const Constraints             &constraints() const override { return constraints_; }
    void                           prescribed(double, Side, State &) const override {}
    Evaluation                     residual(const Point &point, Vector &r) const override;
    std::unique_ptr<Linearisation> make_linearisation() const override;
    void                           linearise(const Point &point, Linearisation &linearisation) const override;
    Energetics                     energetics(const State &state, Side side) const override;
    std::vector<Vector>            rigid_motions(const Vector &w) const override;
    std::vector<double>            events(double, double) const override { return {}; }
    std::vector<std::string>       names() const override { return {"x", "y"}; }

  private:
    SpringPendulumParameters parameters_;
    WorkLedger              &ledger_;
    Constraints              constraints_;
    Vector                   layout_;
  };
} // namespace myolines
