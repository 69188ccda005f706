// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>

namespace myolines
{
  struct Muscle3dParameters;

  /// What an activation may be: filtered measurements overshoot 1 by a little.
  inline const scene::Range activation_range = scene::Range::closed(0, 1.1);

  /// Declares the lists `activation`, `excitation` (from which the activation follows by Zajac's equation) and `activation regions`, and
  /// reads them. @throws InputError for activations outside activation_range, excitations
  /// outside [0, 1] and for what is given twice.
  void add_activation(scene::Schema &system);
  void read_activation(const scene::Node &system, Muscle3dParameters &parameters); ///< The reading of these lists.
} // namespace myolines
