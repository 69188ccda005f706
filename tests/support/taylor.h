// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/semi_discrete_system.h>

#include <gtest/gtest.h>

namespace myolines::testing
{
  inline Vector residual_at(const SemiDiscreteSystem &system, const State &s)
  {
    Vector           r(s.u);
    const Evaluation evaluation = system.residual({s.t, Side::left, s.u, s.v, s.a}, r);
    EXPECT_TRUE(evaluation.admissible) << evaluation.reason;
    return r;
  }

  /// |J x - difference| / |difference| of the system at @p state, J with the weights @p by_order, in the direction w x: differences of
  /// fourth order, of size @p h.
  inline double taylor_error(const SemiDiscreteSystem &system, const State &state, const WeightsByOrder &by_order, const Weights &w,
                             const Vector &x, const double h)
  {
    const auto moved = [&](const double size) {
      State s = state;
      s.u.add(size * w.u, x);
      s.v.add(size * w.v, x);
      s.a.add(size * w.a, x);
      return residual_at(system, s);
    };
    Vector     y(x);
    const auto linearisation = system.make_linearisation();
    system.linearise({state.t, Side::left, state.u, state.v, state.a}, *linearisation);
    linearisation->apply(by_order, x, y);
    Vector difference = moved(h);
    difference -= moved(-h);
    difference *= 8;
    difference += moved(-2 * h);
    difference -= moved(2 * h);
    difference *= 1 / (12 * h);
    y -= difference;
    return y.l2_norm() / difference.l2_norm();
  }

  /// With the weights of a stage: unknowns of first order have no accelerations.
  inline double taylor_error(const SemiDiscreteSystem &system, const State &state, const Weights &w, const Vector &x, const double h)
  {
    return taylor_error(system, state, stage_weights(w.u, w.v, w.a), w, x, h);
  }
} // namespace myolines::testing
