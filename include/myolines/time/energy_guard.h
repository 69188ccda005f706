// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/time/integrator.h>

namespace myolines
{
  /// Adds `largest gain` to the parameters of a control of steps.
  void add_largest_gain(scene::Schema &control);

  /// Refuses steps of @p method in which the balance of energy gains more than "time/control/largest gain" (Outcome::energy_gained); the
  /// method as it is where the scene does not ask for that. The energy is measured at the end of every step.
  /// @throws InputError if @p system does not state its energy.
  std::unique_ptr<Integrator> guard_energy(std::unique_ptr<Integrator> method, const scene::Node &time, const SemiDiscreteSystem &system);
} // namespace myolines
