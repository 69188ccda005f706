// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace myolines
{
  /// Rates at which energy comes into a system and leaves it [W].
  struct EnergyRates
  {
    double active      = 0; ///< power of what is active in it
    double dissipation = 0; ///< of what damps, >= 0
    double external    = 0; ///< power of loads and of prescribed motion
  };

  /// What a system says of its energy at one state: in time d(energy)/dt = active - dissipation + external.
  struct Energetics
  {
    double      energy = 0; ///< kinetic and stored [J]
    EnergyRates rates;      ///< of its change
  };
} // namespace myolines
