// SPDX-License-Identifier: LGPL-2.1-or-later
// The equations of pressures that are kept as unknowns beside displacements.
#include "muscle3d_linearisation.h"

namespace myolines
{
  namespace
  {
    /// A state, of which kernels find B and the A of a step, and the W of every owned batch.
    class KeptVolume : public LocalEquations::Elimination
    {
    public:
      KeptVolume(const Muscle3dDiscretisation &discretisation, const CellSweep &sweep, const KernelModel &model, const Vector &u,
                 const Vector &before)
        : d_(discretisation)
        , sweep_(sweep)
        , model_(model)
        , u_(u)
        , size_(std::size_t(d_.element.n_modes) * d_.element.n_modes * n_lanes)
        , stiffness_(d_.batches->n_owned_batches() * size_)
        , b_(d_.element.n_modes * n_lanes)
        , z_(b_)
      {
        u_.update_ghost_values();
        if (model_.before == nullptr)
          return;
        before_ = before;
        before_.update_ghost_values();
        model_.before = before_.begin();
      }

      const KernelModel &model() const { return model_; }
      double            *stiffness(const unsigned int b) { return &stiffness_[b * size_]; }

      void condense(const Vector &b_z, Vector &b) const override
      {
        b.zero_out_ghost_values();
        for (unsigned int batch = 0; batch < d_.batches->n_owned_batches(); ++batch)
          {
            d_.modes->get(b_z, batch, b_.data());
            d_.kernels.condense(sweep_.tables, model_, sweep_.cells(batch), u_.begin(), &stiffness_[batch * size_], b_.data(), b.begin(),
                                d_.scratch());
          }
        b.compress(dealii::VectorOperation::add);
      }

      void recover(const double weight, const Vector &x, const Vector &b_z, Vector &z) const override
      {
        const CurrentGhosts current(x);
        z.zero_out_ghost_values();
        for (unsigned int batch = 0; batch < d_.batches->n_owned_batches(); ++batch)
          {
            d_.modes->get(b_z, batch, b_.data());
            d_.kernels.recover(sweep_.tables, model_, sweep_.cells(batch), u_.begin(), &stiffness_[batch * size_], weight, current.begin(),
                               b_.data(), z_.data(), d_.scratch());
            d_.modes->set(z_.data(), batch, z);
          }
      }

    private:
      const Muscle3dDiscretisation         &d_;
      const CellSweep                       sweep_;
      KernelModel                           model_;
      Vector                                u_, before_;
      const std::size_t                     size_;
      dealii::AlignedVector<double>         stiffness_; ///< [batch][mode][mode] lanes
      mutable dealii::AlignedVector<double> b_, z_;
    };
  } // namespace

  template <typename Use>
  void Muscle3dLinearisation::for_each_volume(const Use &use) const
  {
    store_tangents();
    for (unsigned int b = 0; b < discretisation_.batches->n_owned_batches(); ++b)
      use(b, tangents_.volume_of(b));
  }

  Vector Muscle3dLinearisation::local_scale(const bool eliminated) const
  {
    Vector              scale   = make_local();
    const int           n_modes = discretisation_.element.n_modes;
    const VolumeLayout  layout(n_modes);
    std::vector<double> lanes(n_modes * n_lanes);
    for_each_volume([&](const unsigned int b, const double *volume) {
      const double *shear = volume + layout.shear * n_lanes, *bulk = shear + n_lanes;
      for (int i = 0; i < n_modes; ++i)
        for (int lane = 0; lane < n_lanes; ++lane)
          lanes[i * n_lanes + lane] = !eliminated && shear[lane] > 0 ? shear[lane] : bulk[lane];
      discretisation_.modes->set(lanes.data(), b, scale);
    });
    return scale;
  }

  void Muscle3dLinearisation::apply_with_local(const WeightsByOrder &weights, const Digits digits, const Vector &x, const Vector &z,
                                               Vector &y, Vector &y_z) const
  {
    const Weights                &w    = weights[2];
    const double                  k[3] = {w.u, w.v, w.a};
    const CurrentGhosts           current(x);
    const bool                    exact = digits == Digits::all || rounds_pressures();
    const CellSweep               sweep = discretisation_.sweep(materials_);
    const int                     n     = sweep.element.n_modes * n_lanes;
    dealii::AlignedVector<double> dp(n), rows(n);
    store_tangents(exact);
    y.zero_out_ghost_values();
    y = 0;
    y_z.zero_out_ghost_values();
    for (unsigned int b = 0; b < sweep.batches.n_owned_batches(); ++b)
      {
        const KernelPressure pressure{dp.data(), rows.data()};
        discretisation_.modes->get(z, b, dp.data());
        discretisation_.kernels.apply(sweep.tables, model_, sweep.cells(b), k, tangent(tangents_, b, exact), current.begin(), y.begin(),
                                      &pressure, discretisation_.scratch());
        for (double &row : rows)
          row *= w.u;
        discretisation_.modes->set(rows.data(), b, y_z);
      }
    if (w.u != 0 || w.v != 0)
      add_faces(w, current.vector(), y);
    y.compress(dealii::VectorOperation::add);
    ledger_.count("tangent actions");
  }

  void Muscle3dLinearisation::local_residual(Vector &g) const
  {
    const VolumeLayout layout(discretisation_.element.n_modes);
    g.zero_out_ghost_values();
    for_each_volume(
        [&](const unsigned int b, const double *volume) { discretisation_.modes->set(volume + layout.residual * n_lanes, b, g); });
  }

  std::unique_ptr<LocalEquations::Elimination> Muscle3dLinearisation::eliminate(const bool softened) const
  {
    const CellSweep sweep = softened ? lean_sweep() : discretisation_.sweep(materials_); // softened: for preconditioners
    auto            kept  = std::make_unique<KeptVolume>(discretisation_, sweep, model(softened), u_, before_);
    for (unsigned int b = 0; b < sweep.batches.n_owned_batches(); ++b)
      discretisation_.kernels.stiffness(sweep.tables, kept->model(), cells(sweep, b), u_.begin(), kept->stiffness(b),
                                        discretisation_.scratch());
    ledger_.count("volumes kept");
    return kept;
  }
} // namespace myolines
