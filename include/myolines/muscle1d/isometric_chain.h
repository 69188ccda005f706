// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle1d/muscle1d_system.h>
#include <myolines/scene/scene.h>

namespace myolines
{
  /// A fully active muscle of N elements and N - 1 masses at fixed length, thesis (3.2.1) and (3.3.12). It starts at rest from
  /// u_i = p sin(i^2), i = 1..N-1, with the perturbation p.
  scene::Schema isometric_chain_schema();
  Muscle1dParameters
  read_isometric_chain(const scene::Node &system); ///< Reads that list. @throws InputError for what ranges cannot express.
} // namespace myolines
