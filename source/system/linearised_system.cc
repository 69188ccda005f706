// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/linearised_system.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines
{
  LinearisedSystem::LinearisedSystem(std::unique_ptr<SemiDiscreteSystem> system)
    : system_(std::move(system))
    , capabilities_(system_->capabilities())
    , zero_(system_->initial_state(0).u)
    , linearisation_(system_->make_linearisation())
    , product_(zero_)
  {
    zero_ = 0;
    zero_.update_ghost_values();
    linearise({0, Side::right, zero_, zero_, zero_}, *linearisation_);
    capabilities_.linear = true;
    capabilities_.energy = false;
    capabilities_.splits.clear();
  }

  Evaluation LinearisedSystem::residual(const Point &point, Vector &r) const
  {
    const auto apply = [&](const Weights &w, const Vector &x, Vector &y) { linearisation_->apply(stage_weights(w.u, w.v, w.a), x, y); };
    apply({1, 0, 0}, point.u, r);
    if (capabilities_.rates)
      {
        apply({0, 1, 0}, point.v, product_);
        r += product_;
      }
    if (capabilities_.inertia)
      {
        apply({0, 0, 1}, point.a, product_);
        r += product_;
      }
    const bool finite = std::all_of(r.begin(), r.begin() + r.locally_owned_size(), [](const double x) { return std::isfinite(x); });
    if (dealii::Utilities::MPI::min(finite ? 1 : 0, r.get_mpi_communicator()) == 1)
      return {};
    r = std::numeric_limits<double>::quiet_NaN();
    return {false, "the linear forces are not finite numbers"};
  }

  void LinearisedSystem::linearise(const Point &, Linearisation &linearisation) const
  {
    system_->linearise({0, Side::right, zero_, zero_, zero_}, linearisation);
  }
} // namespace myolines
