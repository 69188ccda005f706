// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/fem/node_space.h>

#include <deal.II/base/tensor.h>

namespace myolines
{
  /// Mean of a vector field over boundary faces of the reference body, int u dA / int dA.
  class FaceMean
  {
  public:
    /// Of the faces with boundary id @p face, which has an area. Collective; @p space must outlive the object.
    FaceMean(const NodeSpace &space, dealii::types::boundary_id face);

    /// Of displacements or velocities: @p x has one entry for each unknown. Collective.
    dealii::Tensor<1, 3> of(const Vector &x) const;

    double area() const { return area_; } ///< [m^2]

  private:
    const NodeSpace                                  &space_;
    std::map<dealii::types::global_dof_index, double> weights_; ///< of the nodes of own cells; they sum to 1 over all ranks
    double                                            area_ = 0;
  };
} // namespace myolines
