// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/system/semi_discrete_system.h>

namespace myolines
{
  /// True if the list `time` of @p scene starts from a state that a run has saved.
  /// @throws InputError if it does and names none, or does not and names one, or asks for an impulse of the boundary beside it.
  bool starts_from_saved(const scene::Node &scene);

  /// Displacements and velocities of the state that @p scene names, at the time @p t0 and with what the conditions of @p system prescribe
  /// then. Collective.
  /// @throws InputError if the file is none, or damaged, or of another kind of system, geometry or discretisation.
  State saved_start(const scene::Node &scene, const SemiDiscreteSystem &system, double t0);
} // namespace myolines
