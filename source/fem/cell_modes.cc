// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/cell_modes.h>

namespace myolines
{
  CellModes::CellModes(const NodeSpace &space, const CellBatches &batches, const unsigned int n)
    : batches_(batches)
    , n_(n)
  {
    const dealii::types::global_dof_index size = dealii::types::global_dof_index(space.mesh().n_global_active_cells()) * n;
    dealii::IndexSet                      owned(size), ghosts(size);
    for (unsigned int b = 0; b < batches.n_batches(); ++b)
      for (unsigned int lane = 0; lane < batches.n_filled(b); ++lane)
        {
          const dealii::types::global_dof_index first = batches.cell(b, lane)->global_active_cell_index() * n;
          (b < batches.n_owned_batches() ? owned : ghosts).add_range(first, first + n);
        }
    partitioner_ = std::make_shared<dealii::Utilities::MPI::Partitioner>(owned, ghosts, space.communicator());
    places_.assign(std::size_t(batches.n_batches()) * n_lanes, 0);
    for (unsigned int b = 0; b < batches.n_batches(); ++b)
      for (unsigned int lane = 0; lane < batches.n_filled(b); ++lane)
        places_[b * n_lanes + lane] = partitioner_->global_to_local(batches.cell(b, lane)->global_active_cell_index() * n);
  }

  void CellModes::get(const Vector &x, const unsigned int b, double *lanes) const
  {
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      for (unsigned int i = 0; i < n_; ++i)
        lanes[i * n_lanes + lane] = lane < batches_.n_filled(b) ? x.local_element(places_[b * n_lanes + lane] + i) : 0.;
  }

  void CellModes::set(const double *lanes, const unsigned int b, Vector &x) const
  {
    for (unsigned int lane = 0; lane < batches_.n_filled(b); ++lane)
      for (unsigned int i = 0; i < n_; ++i)
        x.local_element(places_[b * n_lanes + lane] + i) = lanes[i * n_lanes + lane];
  }
} // namespace myolines
