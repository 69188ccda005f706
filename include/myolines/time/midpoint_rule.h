// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/alpha_method.h>

namespace myolines
{
  /// M (v_1 - v_0)/dt + F = 0, u_1 - u_0 = dt (v_0 + v_1)/2, with @p force the averaged state or two states. Nonlinear solves are as
  /// accurate as their own tolerance asks for, also where steps are chosen by error: what is left of the equations is not conserved.
  ///
  /// With `composition` = `suzuki` a step is five of these, over the parts p, p, 1 - 4 p, p, p of dt with p = 1/(4 - 4^(1/3)) (Suzuki,
  /// doi:10.1016/0375-9601(90)90962-N; Hairer, Lubich and Wanner, doi:10.1007/3-540-30666-8, II.4). As the rule is symmetric, they are of
  /// order 4; they conserve what the rule conserves, and none of them ends outside the step.
  IntegratorEntry midpoint_entry(ForceEvaluation force, const MethodFacts &facts);
} // namespace myolines
