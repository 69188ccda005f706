// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/output/output_folder.h>
#include <myolines/time/loop.h>

#include <functional>

namespace myolines
{
  /// Follows the balance of energy: @p rates after every step, the energy of @p system, which is borrowed, at some, and where the run
  /// restarts or ends.
  std::unique_ptr<Observer> make_energy_watch(const SemiDiscreteSystem &system, std::function<EnergyRates(const State &)> rates,
                                              const OutputFolder &folder);

  /// What a person should know of the balance @p report at the end of a run with the method @p method, in lines: the drift; whether it is
  /// the damping of the method; warnings, where energy came from nowhere.
  std::vector<std::string> energy_lines(const EnergyReport &report, const std::string &method);
} // namespace myolines
