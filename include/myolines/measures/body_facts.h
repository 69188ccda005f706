// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/muscle3d_system.h>

#include <string>
#include <vector>

namespace myolines
{
  /// Lines for `check` about the body at rest: line of action, volume and mass, fascicles and, from them, physiological cross-section and
  /// force. Traces fascicles; collective.
  ///
  ///     cross-section = volume of the muscle tissue / mean length of fascicles  [m^2],
  ///     F_0           = int sigma_0 dV / mean length of fascicles               [N],
  ///
  /// without the cosine of the pennation angle (Powell et al., doi:10.1152/jappl.1984.57.6.1715, have it in the first).
  std::vector<std::string> body_facts(const Muscle3dSystem &system);
} // namespace myolines
