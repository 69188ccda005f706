// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/vector.h>
#include <myolines/system/local_unknowns.h>

#include <array>
#include <string>

namespace myolines
{
  /// Side of a kink in a drive: a step starts on the right limit of one and ends on the left limit of the next.
  enum class Side
  {
    left, ///< the limit from before
    right ///< the limit from after
  };

  /// What an integrator carries from step to step: u, v = du/dt, a = d2u/dt2 of every unknown at time t [s].
  struct State
  {
    double t = 0; ///< [s]
    Vector u;     ///< displacement [m], with ghosts
    Vector v;     ///< du/dt [m/s]
    Vector a;     ///< d2u/dt2 [m/s^2]
  };

  /// Without copies; std::swap would make three, as vectors have no move assignment.
  inline void swap(State &left, State &right)
  {
    std::swap(left.t, right.t);
    left.u.swap(right.u);
    left.v.swap(right.v);
    left.a.swap(right.a);
  }

  /// Arguments of a residual. t is the instant of u, v, a and of the loads. Borrowed: the vectors outlive the point.
  struct Point
  {
    double        t;    ///< [s]
    Side          side; ///< of a kink at t
    const Vector &u;    ///< displacement [m]
    const Vector &v;    ///< velocity [m/s]
    const Vector &a;    ///< acceleration [m/s^2]

    const LocalUnknowns *local = nullptr; ///< z, or none: z(u), eliminated
    /// Displacement at the beginning of a step that ends at u, or none. Of systems with Capabilities::two_states: forces are then those of
    /// the step, which are not those of any state between (SemiDiscreteSystem::residual); t, v and a are means of the step.
    const Vector *before = nullptr;
    /// chi >= 0: forces of such a step take energy, by chi/2 times the difference of those at both ends (SemiDiscreteSystem::residual).
    double dissipation = 0;
  };

  /// J = w.u dR/du + w.v dR/dv + w.a dR/da; any weight may be zero.
  struct Weights
  {
    double u = 0; ///< of K = dR/du
    double v = 0; ///< of C = dR/dv
    double a = 0; ///< of M = dR/da
  };

  /// Weights by differential order of the unknown: [0] algebraic, [1] first order, [2] second order in time.
  using WeightsByOrder = std::array<Weights, 3>;

  /// Weights of one implicit stage (u, v, a) = (u~, v~, a~) + (c_u, c_v, c_a) d, of which an unknown meets as many as its order says.
  inline WeightsByOrder stage_weights(const double c_u, const double c_v, const double c_a)
  {
    return {{Weights{c_u, 0, 0}, Weights{c_u, c_v, 0}, Weights{c_u, c_v, c_a}}};
  }

  /// What a residual says of its arguments. Inadmissible (det F <= 0, not a number, ...) is a value, agreed by all ranks.
  struct Evaluation
  {
    bool        admissible = true; ///< whether R exists there
    std::string reason     = "";   ///< why not, in words; empty if admissible

    /// l2 norm of the forces that R balances, inertia left out, before they cancel [unit of R]; 0: the system does not tell.
    double forces = 0;
    /// Size of the residual of the equation of local unknowns that are given, brought to the unit of R; 0: there are none, or it holds.
    double local = 0;
    /// l2 norm of what the rounding of u leaves of R at best [unit of R].
    double rounding = 0;
  };
} // namespace myolines
