// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/fem/node_space.h>

namespace myolines
{
  /// The solution phi of Laplace's equation in the body with phi = 0 on the nodes of face @p from, 1 on those of face @p to and no flux
  /// through the others, at the nodes of the space (ghosted). Collective. Muscle architecture by its gradient: Choi and Blemker (2013),
  /// doi:10.1371/journal.pone.0077576.
  Vector laplace_potential(const NodeSpace &space, dealii::types::boundary_id from, dealii::types::boundary_id to);
} // namespace myolines
