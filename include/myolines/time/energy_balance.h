// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/archive.h>
#include <myolines/system/energetics.h>

#include <optional>

namespace myolines
{
  /// What became of the energy of a run.
  struct EnergyReport
  {
    /// A rise of the drift between two times.
    struct Gain
    {
      double from = 0; ///< when the drift was lowest [s]
      double to   = 0; ///< when it had risen [s]
      double size = 0; ///< [J], >= 0
    };

    double drift     = 0; ///< [J]
    double exchanged = 0; ///< [J]: size of the energy at the start, and of all works
    Gain   rise;          ///< the largest of the whole run
    Gain   jump;          ///< the largest between two looks at the energy
  };

  /// The balance of energy of a run [J],
  ///
  ///     drift = energy - energy at the start - active work + dissipated - external work,
  ///
  /// works being integrals over time of the rates, trapezoidal between accepted steps. It is zero for the semi-discrete system: what it
  /// becomes is the error of the method and of the rule, of second order in the step. A method that damps lets it fall; a rise is energy
  /// from nowhere.
  class EnergyBalance
  {
  public:
    /// After an accepted step that ends at @p t, with left limits; the first time the balance begins.
    void accepted(double t, const Energetics &now);

    /// The same where nobody looks at the energy, not the first time.
    void accepted(double t, const EnergyRates &now);

    /// A smooth piece begins, with right limits: at the start, or at an event, where velocities may jump. The energy of a jump, since the
    /// last look, is work of the boundary that jumps.
    void restarted(double t, const Energetics &now);

    bool   started() const { return before_.has_value(); }                          ///< whether the balance has begun
    bool   looked_at(const double t) const { return started() && looked_at_ == t; } ///< whether the energy is known
    double active_work() const { return works_.active; }                            ///< of what is active, since the start [J]
    double dissipated() const { return works_.dissipation; }                        ///< since the start [J], >= 0
    double external_work() const { return works_.external; }                        ///< of loads and prescribed motion, since the start [J]

    /// As of the last energy.
    const EnergyReport &report() const { return report_; }

    void save(Archive &archive) const; ///< all of it, for a checkpoint
    void load(const Archive &archive); ///< if it was saved there

  private:
    struct Instant
    {
      double      t;
      EnergyRates rates;
    };

    void look(double t, double energy);

    std::optional<Instant> before_;
    double                 energy_at_start_ = 0;
    EnergyRates            works_;                   ///< [J]
    double                 looked_at_ = 0;           ///< when the energy was looked at last [s]
    double                 lowest_ = 0, low_at_ = 0; ///< least drift so far [J], and when [s]
    EnergyReport           report_;
  };
} // namespace myolines
