// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/norm.h>
#include <myolines/muscle3d/loads.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

namespace myolines
{
  Loads::Loads(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation, const SurfaceForces &surface)
    : discretisation_(discretisation)
    , surface_(surface)
  {
    for (const auto &condition : parameters.boundary)
      if (condition->facts().prescribes())
        motions_.push_back({condition, discretisation.space->face_nodes(condition->facts().face)});
    if (parameters.body_force)
      body_force_ = std::make_unique<VectorFormula>(*parameters.body_force);
  }

  void Loads::prescribe(const double t, const Side side, State &state) const
  {
    for (const Motion &given : motions_)
      {
        const BoundaryCondition::Motion motion = given.condition->motion(t, side);
        for (const auto node : given.nodes)
          {
            const std::array<Vector3, 3> x = motion(discretisation_.space->node_position(node));
            for (unsigned int c = 0; c < 3; ++c)
              if (given.condition->facts().prescribed[c])
                {
                  state.u(3 * node + c) = x[0][c];
                  state.v(3 * node + c) = x[1][c];
                  state.a(3 * node + c) = x[2][c];
                }
          }
      }
  }

  void Loads::add_body_force(const double t, Vector &f) const
  {
    if (!body_force_)
      return;
    const NodeSpace                             &space = *discretisation_.space;
    const dealii::FiniteElement<3>              &fe    = space.nodes().get_fe();
    dealii::FEValues<3>                          values(fe, dealii::QGauss<3>(discretisation_.element.n_points_1d),
                                                        dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values);
    std::vector<dealii::types::global_dof_index> nodes(fe.n_dofs_per_cell());
    for (const auto &cell : space.nodes().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell->get_dof_indices(nodes);
          for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
            for (unsigned int c = 0; c < 3; ++c)
              if (!body_force_->zero(c))
                {
                  const double weighted = (*body_force_)(c, values.quadrature_point(q), t) * values.JxW(q);
                  for (unsigned int i = 0; i < nodes.size(); ++i)
                    f(3 * nodes[i] + c) += weighted * values.shape_value(i, q);
                }
        }
  }

  double Loads::subtract_external(const double t, const Side side, Vector &r) const
  {
    Vector f = discretisation_.space->make_vector();
    surface_.add_loads(t, side, f);
    add_body_force(t, f);
    f.compress(dealii::VectorOperation::add);
    r -= f;
    return norm_or_nan(f); // a load may be no number
  }

  double Loads::load_power(const double t, const Side side, const Vector &v) const
  {
    Vector f = discretisation_.space->make_vector();
    surface_.add_loads(t, side, f);
    f.compress(dealii::VectorOperation::add);
    return f * v;
  }

  double Loads::body_force_power(const double t, const Vector &v) const
  {
    Vector f = discretisation_.space->make_vector();
    add_body_force(t, f);
    f.compress(dealii::VectorOperation::add);
    return f * v;
  }
} // namespace myolines
