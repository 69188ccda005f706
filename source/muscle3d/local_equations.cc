// SPDX-License-Identifier: LGPL-2.1-or-later
// The equations of pressures that are kept as unknowns beside displacements.
#include "muscle3d_linearisation.h"

namespace myolines
{
  namespace
  {
    /// B and W of every owned batch, and of a step the A of forces.
    class KeptVolume : public LocalEquations::Elimination
    {
    public:
      KeptVolume(const Muscle3dDiscretisation &discretisation, const bool step)
        : d_(discretisation)
        , n_modes_(d_.element.n_modes)
        , n_(3 * d_.element.n_nodes)
        , size_(std::size_t(n_modes_) * n_ * n_lanes)
        , n_columns_(step ? 2 : 1)
        , columns_(d_.batches->n_owned_batches() * n_columns_ * size_)
        , stiffness_(std::size_t(d_.batches->n_owned_batches()) * n_modes_ * n_modes_ * n_lanes)
        , p_(n_modes_ * n_lanes)
        , Wp_(p_)
        , nodal_(n_ * n_lanes)
      {}

      double *columns(const unsigned int b) { return &columns_[b * n_columns_ * size_]; }
      double *stiffness(const unsigned int b) { return &stiffness_[std::size_t(b) * n_modes_ * n_modes_ * n_lanes]; }

      void condense(const Vector &b_z, Vector &b) const override
      {
        b.zero_out_ghost_values();
        for (unsigned int batch = 0; batch < d_.batches->n_owned_batches(); ++batch)
          {
            d_.modes->get(b_z, batch, p_.data());
            stiffen(batch);
            const double *A = &columns_[((batch + 1) * n_columns_ - 1) * size_]; // the last
            std::fill(nodal_.begin(), nodal_.end(), 0);
            for (int i = 0; i < n_modes_; ++i)
              for (int j = 0; j < n_; ++j)
                for (int lane = 0; lane < n_lanes; ++lane)
                  nodal_[j * n_lanes + lane] += A[(i * n_ + j) * n_lanes + lane] * Wp_[i * n_lanes + lane];
            for_each_entry(batch, [&](const std::size_t at, const unsigned int entry) { b.local_element(entry) += nodal_[at]; });
          }
        b.compress(dealii::VectorOperation::add);
      }

      void recover(const double weight, const Vector &x, const Vector &b_z, Vector &z) const override
      {
        const CurrentGhosts current(x);
        z.zero_out_ghost_values();
        for (unsigned int batch = 0; batch < d_.batches->n_owned_batches(); ++batch)
          {
            d_.modes->get(b_z, batch, p_.data());
            const double *B = &columns_[batch * n_columns_ * size_];
            std::fill(nodal_.begin(), nodal_.end(), 0);
            for_each_entry(batch, [&](const std::size_t at, const unsigned int entry) { nodal_[at] = current.begin()[entry]; });
            for (int i = 0; i < n_modes_; ++i)
              {
                double *p = &p_[i * n_lanes];
                for (int lane = 0; lane < n_lanes; ++lane)
                  p[lane] *= -1 / weight;
                for (int j = 0; j < n_; ++j)
                  for (int lane = 0; lane < n_lanes; ++lane)
                    p[lane] += B[(i * n_ + j) * n_lanes + lane] * nodal_[j * n_lanes + lane];
              }
            stiffen(batch);
            d_.modes->set(Wp_.data(), batch, z);
          }
      }

    private:
      /// Wp_ = W p_
      void stiffen(const unsigned int batch) const
      {
        const double *W = &stiffness_[std::size_t(batch) * n_modes_ * n_modes_ * n_lanes];
        std::fill(Wp_.begin(), Wp_.end(), 0);
        for (int i = 0; i < n_modes_; ++i)
          for (int j = 0; j < n_modes_; ++j)
            for (int lane = 0; lane < n_lanes; ++lane)
              Wp_[i * n_lanes + lane] += W[(i * n_modes_ + j) * n_lanes + lane] * p_[j * n_lanes + lane];
      }

      /// use(place in nodal_, local number in vectors)
      template <typename Use>
      void for_each_entry(const unsigned int batch, const Use &use) const
      {
        const unsigned int *nodes   = d_.batches->nodes(batch);
        const unsigned int  n_nodes = d_.element.n_nodes, n_filled = d_.batches->n_filled(batch);
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int i = 0; i < n_nodes; ++i)
            for (unsigned int lane = 0; lane < n_filled; ++lane)
              use((c * n_nodes + i) * n_lanes + lane, 3 * nodes[i * n_lanes + lane] + c);
      }

      const Muscle3dDiscretisation         &d_;
      const int                             n_modes_, n_;
      const std::size_t                     size_, n_columns_; ///< of the columns of a batch, and how many sets it has
      dealii::AlignedVector<double>         columns_;          ///< [batch][B, A][mode][component][node] lanes
      dealii::AlignedVector<double>         stiffness_;        ///< [batch][mode][mode] lanes
      mutable dealii::AlignedVector<double> p_, Wp_, nodal_;
    };
  } // namespace

  template <typename Use>
  void Muscle3dLinearisation::for_each_volume(const Use &use) const
  {
    store_tangents();
    const Element    &element = discretisation_.element;
    const std::size_t size    = tangent_size(element.n_points, element.n_modes, model_),
                      behind  = std::size_t(element.n_points) * point_tangent_size(model_) * n_lanes;
    for (unsigned int b = 0; b < discretisation_.batches->n_owned_batches(); ++b)
      use(b, &tangents_[b * size + behind]);
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

  void Muscle3dLinearisation::apply_with_local(const WeightsByOrder &weights, const Vector &x, const Vector &z, Vector &y,
                                               Vector &y_z) const
  {
    const Weights                &w    = weights[2];
    const double                  k[3] = {w.u, w.v, w.a};
    const CurrentGhosts           current(x);
    const CellSweep               sweep = discretisation_.sweep(materials_);
    const std::size_t             size  = myolines::tangent_size(sweep.element.n_points, sweep.element.n_modes, model_);
    const int                     n     = sweep.element.n_modes * n_lanes;
    dealii::AlignedVector<double> dp(n), rows(n);
    store_tangents();
    y.zero_out_ghost_values();
    y = 0;
    y_z.zero_out_ghost_values();
    for (unsigned int b = 0; b < sweep.batches.n_owned_batches(); ++b)
      {
        const KernelPressure pressure{dp.data(), rows.data()};
        discretisation_.modes->get(z, b, dp.data());
        discretisation_.kernels.apply(sweep.tables, model_, sweep.cells(b), k, &tangents_[b * size], current.begin(), y.begin(), &pressure,
                                      discretisation_.scratch());
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
    auto            kept  = std::make_unique<KeptVolume>(discretisation_, model_.before != nullptr);
    const CellSweep sweep = discretisation_.sweep(materials_);
    for (unsigned int b = 0; b < sweep.batches.n_owned_batches(); ++b)
      discretisation_.kernels.volume(sweep.tables, model(softened), cells(sweep, b), u_.begin(), kept->columns(b), kept->stiffness(b),
                                     discretisation_.scratch());
    ledger_.count("volumes kept");
    return kept;
  }
} // namespace myolines
