// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace myolines::hill
{
  // Normalised force curves of the one-dimensional Hill muscle and its tendon, thesis appendix A.1 (tables A.1 to A.4), with the
  // printed coefficients: cubics between knots. Where the thesis says nothing, outside the tables, the rules below hold. Values
  // and slopes are continuous to 1e-6, but for the slopes of force_velocity at 0 (8.617 -> 8.745) and of tendon at 1.00472
  // (0.0097 -> 5.67). At a knot the slope is that of the piece to its right.

  /// A curve at a point.
  struct Curve
  {
    double value; ///< [-]
    double slope; ///< by stretch or rate, of the right at a knot
  };

  /// F_A, active force against stretch [-], table A.1: 1 at stretch 1; 0 outside [0.4, 1.7].
  Curve active(double stretch);

  /// F_P, passive force against stretch [-], table A.2: 0 below 0.7, continued by its tangent above 1.65.
  Curve passive(double stretch);

  /// F_V, force-velocity factor against strain rate over the maximum strain rate [-] (negative: shortening), table A.3: 1 at 0;
  /// 0 below -1, constant (1.6) above 1. Rises throughout [-1, 1], by at most 30.7 at 0.0083.
  Curve force_velocity(double rate);

  /// F_T, tendon force against stretch [-], table A.4: 0 below 0, its last, linear piece above 1.058. A slack tendon carries up to
  /// 0.0097 (errata 31).
  Curve tendon(double stretch);

  /// Integral of F_T from stretch 1 [-].
  double tendon_energy(double stretch);
} // namespace myolines::hill
