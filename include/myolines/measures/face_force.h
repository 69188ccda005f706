// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/body_measures.h>

namespace myolines
{
  /// Estimate (6.2.15) of the force that acts on @p face from the quadrature points of the cell nearest to it [N].
  Parts<dealii::Tensor<1, 3>> interior_point_force(const Muscle3dSystem &system, const State &state, unsigned int face);
} // namespace myolines
