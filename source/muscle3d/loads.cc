// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/norm.h>
#include <myolines/muscle3d/loads.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

namespace myolines
{
  namespace
  {
    /// Area that a load is spread over, by @p n_points in either direction.
    double area(const NodeSpace &space, const BoundaryCondition &condition, const unsigned int n_points)
    {
      dealii::FEFaceValues<3> values(space.nodes().get_fe(), dealii::QGauss<2>(n_points),
                                     dealii::update_JxW_values | dealii::update_quadrature_points);
      double                  sum = 0;
      for (const auto &cell : space.nodes().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == condition.face)
              {
                values.reinit(cell, f);
                for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                  if (condition.loads(values.quadrature_point(q)))
                    sum += values.JxW(q);
              }
      return dealii::Utilities::MPI::sum(sum, space.communicator());
    }
  } // namespace

  Loads::Loads(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation)
    : discretisation_(discretisation)
  {
    const NodeSpace &space = *discretisation.space;
    for (const BoundaryCondition &condition : parameters.boundary)
      if (condition.type == BoundaryCondition::Type::traction)
        tractions_.push_back({&condition, VectorFormula(condition.traction)});
      else if (condition.type == BoundaryCondition::Type::pressure || condition.type == BoundaryCondition::Type::directed_traction)
        tractions_.push_back({&condition, {}});
      else if (condition.type == BoundaryCondition::Type::isotonic)
        tractions_.push_back({&condition, {}, area(space, condition, 3)});
      else if (condition.prescribes_motion())
        {
          motions_.push_back({&condition, discretisation.space->face_nodes(condition.face), {}});
          if (condition.type == BoundaryCondition::Type::formula)
            for (const auto *text : {&condition.displacement, &condition.velocity, &condition.acceleration})
              motions_.back().formulas.emplace_back(*text);
        }
    for (const Traction &traction : tractions_)
      if (traction.condition->type != BoundaryCondition::Type::isotonic) // which takes the whole face
        traction.condition->refuse_empty(area(space, *traction.condition, discretisation.element.n_points_1d));
    if (parameters.body_force)
      body_force_ = std::make_unique<VectorFormula>(*parameters.body_force);
  }

  void Loads::prescribe(const double t, const Side side, State &state) const
  {
    for (const Motion &motion : motions_)
      {
        const BoundaryCondition &condition = *motion.condition;
        std::array<double, 3>    strain{}; // value and two derivatives
        if (condition.type == BoundaryCondition::Type::strain)
          strain = {{condition.strain->value(t, side), condition.strain->first_derivative(t, side),
                     condition.strain->second_derivative(t, side)}};
        for (const auto node : motion.nodes)
          for (unsigned int c = 0; c < 3; ++c)
            if (condition.components[c])
              {
                const auto unknown = 3 * node + c;
                for (unsigned int order = 0; order < 3; ++order)
                  {
                    double value = condition.reference_length * strain[order] * condition.direction[c];
                    if (!motion.formulas.empty())
                      value = motion.formulas[order](c, discretisation_.space->node_position(node), t);
                    (order == 0 ? state.u : order == 1 ? state.v : state.a)(unknown) = value;
                  }
              }
      }
  }

  dealii::Tensor<1, 3> Loads::Traction::value(const dealii::Point<3> &x, const dealii::Tensor<1, 3> &normal, const double t,
                                              const double factor) const
  {
    dealii::Tensor<1, 3> T;
    if (!condition->loads(x))
      return T;
    if (condition->type == BoundaryCondition::Type::pressure)
      return -condition->load * factor * normal;
    if (!formula)
      {
        for (unsigned int c = 0; c < 3; ++c)
          T[c] = condition->load * factor / area * condition->direction[c];
        return T;
      }
    for (unsigned int c = 0; c < 3; ++c)
      T[c] = formula->zero(c) ? 0 : (*formula)(c, x, t);
    return T;
  }

  void Loads::add_tractions(const double t, const Side side, Vector &f) const
  {
    if (tractions_.empty())
      return;
    const NodeSpace                             &space = *discretisation_.space;
    const dealii::FiniteElement<3>              &fe    = space.nodes().get_fe();
    dealii::FEFaceValues<3>                      values(fe, dealii::QGauss<2>(discretisation_.element.n_points_1d),
                                                        dealii::update_values | dealii::update_quadrature_points | dealii::update_normal_vectors |
                                                            dealii::update_JxW_values);
    std::vector<dealii::types::global_dof_index> nodes(fe.n_dofs_per_cell());
    for (const Traction &traction : tractions_)
      {
        const double factor = traction.condition->factor(t, side);
        for (const auto &cell : space.nodes().active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int face : cell->face_indices())
              if (cell->face(face)->at_boundary() && cell->face(face)->boundary_id() == traction.condition->face)
                {
                  values.reinit(cell, face);
                  cell->get_dof_indices(nodes);
                  for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                    {
                      const auto T = values.JxW(q) * traction.value(values.quadrature_point(q), values.normal_vector(q), t, factor);
                      if (T.norm_square() != 0) // a load that is no number must be seen
                        for (unsigned int i = 0; i < nodes.size(); ++i)
                          for (unsigned int c = 0; c < 3; ++c)
                            f(3 * nodes[i] + c) += T[c] * values.shape_value(i, q);
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
    add_tractions(t, side, f);
    add_body_force(t, f);
    f.compress(dealii::VectorOperation::add);
    r -= f;
    return norm_or_nan(f); // a load may be no number
  }

  double Loads::traction_power(const double t, const Side side, const Vector &v) const
  {
    Vector f = discretisation_.space->make_vector();
    add_tractions(t, side, f);
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
