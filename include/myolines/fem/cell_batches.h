// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/lanes.h>
#include <myolines/fem/element.h>
#include <myolines/fem/node_space.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/fe/fe_values.h>

#include <vector>

namespace myolines
{
  /// Cells in groups of n_lanes, their data interleaved by lane (struct of arrays), for kernels. First the batches of
  /// locally owned cells, then those of ghost cells (needed to fill owned matrix rows without communication). A batch
  /// with fewer cells than lanes repeats its last cell; results of such lanes are not to be used. The cells of a batch have one
  /// material id.
  class CellBatches
  {
  public:
    CellBatches(const NodeSpace &space, const Element &element); ///< Of all cells that this rank owns or has as ghosts.

    unsigned int n_owned_batches() const { return n_owned_; } ///< Batches of owned cells: those with numbers below.
    unsigned int n_batches() const { return static_cast<unsigned int>(batches_.size()); } ///< Batches of owned and of ghost cells.

    /// Cells in batch @p b, 1..n_lanes.
    unsigned int n_filled(const unsigned int b) const { return batches_[b].n_filled; }
    /// The cell in a lane.
    const NodeSpace::Cell &cell(const unsigned int b, const unsigned int lane) const { return cells_[batches_[b].first_cell + lane]; }

    /// [n_nodes][n_lanes] local numbers of the nodes: entry 3 n + c of a vector's local array is component c.
    const unsigned int *nodes(const unsigned int b) const { return &nodes_[std::size_t(b) * n_nodes_ * n_lanes]; }

    /// Map from the unit cube: for each point 9 lanes d(xi_A)/d(X_J) (A slowest) and one lane det(dX/dxi). The points of an
    /// affine batch share one entry: point q stands at geometry(b) + q * geometry_stride(b).
    const double *geometry(const unsigned int b) const { return &geometry_[batches_[b].geometry]; }
    /// Doubles from one point to the next, 0 in an affine batch.
    unsigned int geometry_stride(const unsigned int b) const { return batches_[b].affine ? 0 : 10 * n_lanes; }

    /// [n_modes][n_modes] lanes: inverse mass matrix of P_{k-1} on the cell.
    const double *inverse_mode_mass(const unsigned int b) const { return &mode_mass_[std::size_t(b) * n_modes_ * n_modes_ * n_lanes]; }

    /// Bytes held.
    std::size_t memory() const;

  private:
    struct Batch
    {
      std::size_t  first_cell;
      unsigned int n_filled;
      bool         affine;
      std::size_t  geometry; ///< where its entries begin in geometry_
    };

    void add_batches(const std::vector<NodeSpace::Cell> &cells, const NodeSpace &space, const Element &element,
                     dealii::FEValues<3> &values);
    void add_geometry(Batch &batch, const Element &element, dealii::FEValues<3> &values);

    int                           n_nodes_, n_modes_;
    unsigned int                  n_owned_ = 0;
    std::vector<Batch>            batches_;
    std::vector<NodeSpace::Cell>  cells_;
    std::vector<unsigned int>     nodes_;
    dealii::AlignedVector<double> geometry_;
    dealii::AlignedVector<double> mode_mass_;
  };

  /// Reference position of a Gauss point of a cell.
  dealii::Point<3> point_position(const Element &element, const NodeSpace::Cell &cell, int q);
} // namespace myolines
