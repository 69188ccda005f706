// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/dirk.h>

#include <string>
#include <vector>

namespace myolines
{
  // Coefficients of the methods of this kind that are built in.

  /// gamma = 1 - 1/sqrt(2): two stages, order 2, L-stable (Alexander, doi:10.1137/0714068). The error is estimated as a fifth of the
  /// difference to u_0 + dt v_1, of first order: then error and tolerance agree in the muscle (doc/error_control.md).
  DirkTable sdirk2_table();

  /// gamma = 0.43587, the root of x^3 - 3 x^2 + 3/2 x - 1/6 in (1/6, 1/2): three stages, order 3, L-stable (the same source). Every formula
  /// b - theta (1, -2, 1) is of second order, as the abscissas are equidistant; with theta = gamma it is that of the first two stages. A
  /// fifth of this makes error and tolerance agree in the muscle.
  DirkTable sdirk3_table();

  /// The trapezoidal rule to t + (2 - sqrt(2)) dt and BDF2 to the end; both implicit stages have one weight. The embedded formula is of
  /// third order (Hosea and Shampine, doi:10.1016/0168-9274(95)00115-8, table 1).
  DirkTable tr_bdf2_table();

  /// The rho-infinity composite method (Noh and Bathe, doi:10.1016/j.compstruc.2018.11.001). With s = sqrt(2 + 2 rho) the published
  /// parameters are g = 2/(2 + s) for the end of the first part, and the weights
  ///
  ///     q_1 = s/4,   q_0 = 1/2 + (g - 1) q_1,   q_2 = 1/2 - g q_1 = g/2
  ///
  /// of the slopes at t, t + g dt and t + dt: both parts solve with one matrix. The embedded formula is the quadrature of third order with
  /// these abscissas; as stages are of second order, it makes a method of third order.
  DirkTable bathe_table(double rho);

  /// ESDIRK of four stages, order 3, L-stable, stages of order 2, with an embedded formula of order 2: the implicit part of ARK3(2)4L[2]SA
  /// (Kennedy and Carpenter, doi:10.1016/S0168-9274(02)00138-1).
  DirkTable esdirk3_table();

  /// ESDIRK of six stages, order 4, L-stable, stages of order 2, with an embedded formula of order 3: the implicit part of ARK4(3)6L[2]SA
  /// (the same source).
  DirkTable esdirk4_table();
} // namespace myolines
