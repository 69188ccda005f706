// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/band_linearisation.h>
#include <myolines/system/ledger.h>
#include <myolines/system/semi_discrete_system.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace myolines
{
  /// The angle u of a mass at the end of a massless rod: u'' + (g / l) sin u = 0, per m l^2.
  class Pendulum : public SemiDiscreteSystem
  {
  public:
    explicit Pendulum(const double angle, WorkLedger &ledger)
      : angle_(angle)
      , ledger_(ledger)
      , layout_(dealii::complete_index_set(1), MPI_COMM_SELF)
    {
      constraints_.close();
      layout_.update_ghost_values();
    }

    /// By the arithmetic-geometric mean of 1 and cos(angle / 2).
    double period() const
    {
      double a = 1, b = std::cos(angle_ / 2);
      while (a - b > 1e-15)
        {
          const double mean = (a + b) / 2;
          b                 = std::sqrt(a * b);
          a                 = mean;
        }
      return 2 * dealii::numbers::PI / (std::sqrt(gravity / length) * a);
    }

    Capabilities capabilities() const override
    {
      Capabilities capabilities;
      capabilities.rates             = false;
      capabilities.symmetric_tangent = true;
      return capabilities;
    }

    std::size_t        n_unknowns() const override { return 1; }
    const Constraints &constraints() const override { return constraints_; }
    void               prescribed(double, Side, State &) const override {}

    State initial_state(const double t0) const override
    {
      State state{t0, layout_, layout_, layout_};
      state.u.local_element(0) = angle_;
      return state;
    }

    Evaluation residual(const Point &point, Vector &r) const override
    {
      r.local_element(0) = point.a.local_element(0) + gravity / length * std::sin(point.u.local_element(0));
      if (std::isfinite(r.local_element(0)))
        return {};
      return {false, "the angle is not a finite number"};
    }

    std::unique_ptr<Linearisation> make_linearisation() const override
    {
      return std::make_unique<StoredBands>(std::vector<unsigned int>{2}, 0, std::vector<unsigned int>{}, ledger_);
    }

    void linearise(const Point &point, Linearisation &linearisation) const override
    {
      auto &bands = dynamic_cast<StoredBands &>(linearisation);
      bands.begin();
      bands.mass(0, 0)      = 1;
      bands.stiffness(0, 0) = gravity / length * std::cos(point.u.local_element(0));
    }

    std::vector<double> events(double, double) const override { return {}; }

  private:
    static constexpr double gravity = 9.81, length = 1; ///< [m/s^2], [m]

    const double angle_; ///< [rad]
    WorkLedger  &ledger_;
    Constraints  constraints_;
    Vector       layout_;
  };
} // namespace myolines
