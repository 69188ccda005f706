// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/current_ghosts.h>

#include <myolines/boundary/face_mean.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

namespace myolines
{
  FaceMean::FaceMean(const NodeSpace &space, const dealii::types::boundary_id face)
    : space_(space)
  {
    const dealii::DoFHandler<3>                 &nodes = space.nodes();
    const dealii::QGauss<2>                      rule(space.degree() + 1);
    dealii::FEFaceValues<3>                      values(nodes.get_fe(), rule, dealii::update_values | dealii::update_JxW_values);
    std::vector<dealii::types::global_dof_index> numbers(nodes.get_fe().n_dofs_per_cell());
    for (const auto &cell : nodes.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == face)
            {
              values.reinit(cell, f);
              cell->get_dof_indices(numbers);
              for (unsigned int q = 0; q < rule.size(); ++q)
                {
                  area_ += values.JxW(q);
                  for (unsigned int i = 0; i < numbers.size(); ++i)
                    if (const double shape = values.shape_value(i, q); shape != 0)
                      weights_[numbers[i]] += shape * values.JxW(q);
                }
            }
    area_ = dealii::Utilities::MPI::sum(area_, space.communicator());
    for (auto &[node, weight] : weights_)
      weight /= area_;
  }

  dealii::Tensor<1, 3> FaceMean::of(const Vector &x) const
  {
    const CurrentGhosts  current(x);
    const Vector        &values = current.vector();
    dealii::Tensor<1, 3> mean;
    for (const auto &[node, weight] : weights_)
      for (unsigned int c = 0; c < 3; ++c)
        mean[c] += weight * values(3 * node + c);
    return dealii::Utilities::MPI::sum(mean, space_.communicator());
  }
} // namespace myolines
