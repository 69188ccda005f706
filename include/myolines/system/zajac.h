// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/drive.h>

#include <memory>

namespace myolines
{
  /// From excitation u to activation a by Zajac's equation, thesis (2.2.5):
  ///
  ///     tau a' = u - (beta + (1 - beta) u) a.
  struct Zajac
  {
    double time_constant = 0.045; ///< tau > 0 [s]
    double ratio         = 0.6;   ///< beta in (0, 1]: tau over the time constant of deactivation

    /// a' [1/s]
    double rate(double excitation, double activation) const { return (excitation - decay(excitation) * activation) / time_constant; }
    double decay(double excitation) const { return ratio + (1 - ratio) * excitation; } ///< beta + (1 - beta) u, the factor of a

    /// The activation that a constant excitation holds.
    double steady(double excitation) const { return excitation / decay(excitation); }
  };

  /// The activation that belongs to an excitation, steady at time 0 and before, or, if the excitation is known from samples, at the first
  /// of them, or where begin() says, by Zajac's equation: integrated beforehand on a grid of 0.4 ms (and the kinks of the excitation) by
  /// the classical Runge-Kutta method, cubic in between; error below 1e-8 where the excitation changes within 10 ms. The table grows as
  /// later times are asked for; what has been answered never changes.
  class ZajacActivation : public Drive
  {
  public:
    ZajacActivation(const Zajac &zajac, std::shared_ptr<const Drive> excitation); ///< Of an @p excitation in [0, 1].
    ~ZajacActivation() override;

    const Drive &excitation() const { return *excitation_; } ///< u(t)

    /// Before anything is asked for: a run begins at @p run_start [s]. Excitations that are no samples are steady there if it is negative;
    /// if it is late, they are followed from so long before it only that the rest is forgotten.
    void begin(double run_start) const;

    double              value(double t, Side side) const override;
    double              first_derivative(double t, Side side) const override;
    double              second_derivative(double t, Side side) const override;
    std::vector<double> kinks(double t0, double t1) const override { return excitation_->kinks(t0, t1); }

  private:
    struct Table;

    bool is_before_start(double t, Side side) const;

    const Zajac                        zajac_;
    const std::shared_ptr<const Drive> excitation_;
    mutable std::unique_ptr<Table>     table_;
  };

  /// @p drive, if it is an activation that belongs to an excitation; else nullptr.
  const ZajacActivation *from_excitation(const Drive *drive);
} // namespace myolines
