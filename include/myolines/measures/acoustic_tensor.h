// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/point_states.h>

namespace myolines
{
  /// Smallest eigenvalue of the acoustic tensor Q_ab = dP_aA/dF_bB n_A n_B over all directions n of the reference body [Pa]: where it is
  /// negative the material has lost its ellipticity, thesis 5.8.2. Rates are frozen; pressure and dilatation are taken point by point.
  double smallest_acoustic_eigenvalue(const Muscle3dParameters &parameters, const Activation &activation, const PointState &point);
} // namespace myolines
