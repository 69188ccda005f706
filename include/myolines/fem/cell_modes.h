// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/fem/cell_batches.h>

#include <memory>
#include <vector>

namespace myolines
{
  /// Distributed vectors of n numbers for each cell, coefficients of its modes, and their exchange with batches of cells.
  class CellModes
  {
  public:
    /// @p n numbers for each cell. The batches outlive the object.
    CellModes(const NodeSpace &space, const CellBatches &batches, unsigned int n);

    /// Zero; ghosts are the ghost cells.
    Vector make_vector() const { return Vector(partitioner_); }

    /// [n] lanes of batch @p b, owned or, with current ghosts of @p x, any; lanes without a cell are zero.
    void get(const Vector &x, unsigned int b, double *lanes) const;

    /// The same back, of an owned batch.
    void set(const double *lanes, unsigned int b, Vector &x) const;

  private:
    const CellBatches                                         &batches_;
    unsigned int                                               n_;
    std::vector<unsigned int>                                  places_; ///< [batch][lane]: local number of the first entry
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner_;
  };
} // namespace myolines
