// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/fem/node_space.h>
#include <myolines/system/linearisation.h>

namespace myolines
{
  /// What sparse LU factors of a matrix over @p space cost when its unknowns are eliminated by nested dissection (George,
  /// doi:10.1137/0710032). Coarse cells are halved again and again across the longest principal axis of their centres; what lies within one
  /// is cut like a cube. A rod or a sheet has small separators and costs far less than a compact body of as many unknowns. All ranks know
  /// all coarse cells and get the same answer. Takes some microseconds per coarse cell.
  FactorisationCost nested_dissection(const NodeSpace &space);
} // namespace myolines
