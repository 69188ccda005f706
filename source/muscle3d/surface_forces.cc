// SPDX-License-Identifier: LGPL-2.1-or-later
#include "current_ghosts.h"

#include <myolines/muscle3d/surface_forces.h>

#include <deal.II/base/quadrature_lib.h>

namespace myolines
{
  namespace
  {
    using Vector3 = dealii::Tensor<1, 3>;

    Vector3 vector3(const std::array<double, 3> &v) { return Vector3({v[0], v[1], v[2]}); }
  } // namespace

  SurfaceForces::SurfaceForces(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation)
    : d_(discretisation)
    , n1_(discretisation.element.n_nodes_1d)
  {
    for (const BoundaryCondition &condition : parameters.boundary)
      if (condition.is_spring() || condition.type == BoundaryCondition::Type::follower_pressure)
        conditions_.push_back({&condition});
    if (!any())
      return;
    const Element &e = d_.element;
    for (int q2 = 0; q2 < e.n_points_1d; ++q2)
      for (int q1 = 0; q1 < e.n_points_1d; ++q1)
        {
          value_.emplace_back();
          d1_.emplace_back();
          d2_.emplace_back();
          for (int i2 = 0; i2 < n1_; ++i2)
            for (int i1 = 0; i1 < n1_; ++i1)
              {
                const auto value      = [&](const int q, const int i) { return e.value[q * n1_ + i]; };
                const auto derivative = [&](const int q, const int i) { return e.derivative[q * n1_ + i]; };
                value_.back().push_back(value(q1, i1) * value(q2, i2));
                d1_.back().push_back(derivative(q1, i1) * value(q2, i2));
                d2_.back().push_back(value(q1, i1) * derivative(q2, i2));
              }
        }
    for (const NodeSpace::Cell &cell : d_.space->nodes().active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int f : cell->face_indices())
          for (std::size_t k = 0; k < conditions_.size(); ++k)
            if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == conditions_[k].given->face)
              add_face(cell, f, k);
    for (Condition &condition : conditions_)
      {
        condition.area = dealii::Utilities::MPI::sum(condition.area, d_.communicator);
        condition.given->refuse_empty(condition.area);
      }
  }

  /// Tangents run along the two axes after that across the face, so that their product points along that one.
  void SurfaceForces::add_face(const NodeSpace::Cell &cell, const unsigned int f, const std::size_t condition)
  {
    const NodeSpace                             &space = *d_.space;
    std::vector<dealii::types::global_dof_index> numbers;
    space.cell_nodes(cell, numbers);
    Face               face{cell, condition, f % 2 == 1 ? 1. : -1., {}, {}, {}};
    const unsigned int axis      = f / 2;
    const int          stride[3] = {1, n1_, n1_ * n1_};
    for (int i2 = 0; i2 < n1_; ++i2)
      for (int i1 = 0; i1 < n1_; ++i1)
        {
          face.places.push_back((f % 2 == 1 ? n1_ - 1 : 0) * stride[axis] + i1 * stride[(axis + 1) % 3] + i2 * stride[(axis + 2) % 3]);
          face.nodes.push_back(space.partitioner().global_to_local(3 * numbers[face.places.back()]) / 3);
        }
    const BoundaryCondition  &given = *conditions_[condition].given;
    const std::vector<double> w     = dealii::QGauss<2>(d_.element.n_points_1d).get_weights();
    for (std::size_t q = 0; q < w.size(); ++q)
      {
        Vector3 X, X1, X2;
        for (std::size_t i = 0; i < face.nodes.size(); ++i)
          {
            const Vector3 at = space.node_position(numbers[face.places[i]]);
            X += value_[q][i] * at;
            X1 += d1_[q][i] * at;
            X2 += d2_[q][i] * at;
          }
        const Vector3 product = face.sign * cross_product_3d(X1, X2);
        const bool    inside  = given.loads(dealii::Point<3>(X));
        face.points.push_back({inside ? w[q] : 0., inside ? w[q] * product.norm() : 0., product / product.norm()});
        if (cell->is_locally_owned())
          conditions_[condition].area += face.points.back().area;
      }
    faces_.push_back(std::move(face));
  }

  double SurfaceForces::Condition::scale(const double t, const Side side) const
  {
    if (given->type == BoundaryCondition::Type::tendon)
      return given->profile ? given->profile->value(t, side) : 0;
    if (given->has_stop())
      return given->stop_position;
    return given->load * given->factor(t, side);
  }

  SurfaceForces::Deformed SurfaceForces::deformed(const Face &face, const std::size_t q, const Vector &u) const
  {
    Deformed         x;
    const NodeSpace &space = *d_.space;
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      {
        const double *at = u.begin() + 3 * face.nodes[i];
        const Vector3 ui({at[0], at[1], at[2]});
        x.u += value_[q][i] * ui;
        if (conditions_[face.condition].given->type == BoundaryCondition::Type::follower_pressure)
          {
            const Vector3 xi = ui + space.node_position(space.partitioner().local_to_global(3 * face.nodes[i]) / 3);
            x.x1 += d1_[q][i] * xi;
            x.x2 += d2_[q][i] * xi;
          }
      }
    return x;
  }

  Vector3 SurfaceForces::force(const Face &face, const std::size_t q, const double scale, const Deformed &x) const
  {
    const Condition         &condition = conditions_[face.condition];
    const BoundaryCondition &given     = *condition.given;
    const FacePoint         &point     = face.points[q];
    if (given.type == BoundaryCondition::Type::follower_pressure)
      return -scale * point.weight * face.sign * cross_product_3d(x.x1, x.x2);
    if (given.spring)
      {
        const Vector3 n = vector3(given.direction);
        return given.spring->force(scale - n * x.u) / condition.area * point.area * n;
      }
    return -point.area * (given.stiffness * x.u + given.normal_stiffness * (x.u * point.normal) * point.normal);
  }

  void SurfaceForces::add_tangent(const Face &face, const std::size_t q, const double scale, const Deformed &x,
                                  dealii::FullMatrix<double> &K) const
  {
    const Condition         &condition = conditions_[face.condition];
    const BoundaryCondition &given     = *condition.given;
    const FacePoint         &point     = face.points[q];
    const bool               pressure  = given.type == BoundaryCondition::Type::follower_pressure;
    dealii::Tensor<2, 3>     by_x1, by_x2, k; // force = -(by_x1 dx1 + by_x2 dx2 + k du)
    if (pressure)
      for (unsigned int c = 0; c < 3; ++c)
        {
          Vector3 unit;
          unit[c]             = 1;
          const double  p     = scale * point.weight * face.sign;
          const Vector3 first = p * cross_product_3d(unit, x.x2), second = p * cross_product_3d(x.x1, unit);
          for (unsigned int a = 0; a < 3; ++a)
            {
              by_x1[a][c] = first[a];
              by_x2[a][c] = second[a];
            }
        }
    else if (given.spring)
      {
        const Vector3 n = vector3(given.direction);
        k               = given.spring->slope(scale - n * x.u) / condition.area * point.area * outer_product(n, n);
      }
    else
      {
        k = given.normal_stiffness * point.area * outer_product(point.normal, point.normal);
        for (unsigned int a = 0; a < 3; ++a)
          k[a][a] += given.stiffness * point.area;
      }
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      for (std::size_t j = 0; j < face.nodes.size(); ++j)
        {
          const dealii::Tensor<2, 3> block = value_[q][i] * (pressure ? d1_[q][j] * by_x1 + d2_[q][j] * by_x2 : value_[q][j] * k);
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int c = 0; c < 3; ++c)
              K(3 * i + a, 3 * j + c) += block[a][c];
        }
  }

  template <typename Visitor>
  void SurfaceForces::for_each_point(const Vector &u, const Visitor &visit) const
  {
    for (const Face &face : faces_)
      if (face.cell->is_locally_owned())
        for (std::size_t q = 0; q < face.points.size(); ++q)
          if (face.points[q].weight > 0)
            visit(face, conditions_[face.condition], q, deformed(face, q, u));
  }

  double SurfaceForces::subtract(const double t, const Side side, const Vector &u, Vector &r) const
  {
    double squares = 0;
    for_each_point(u, [&](const Face &face, const Condition &condition, const std::size_t q, const Deformed &x) {
      const Vector3 at = force(face, q, condition.scale(t, side), x);
      squares += at * at;
      for (std::size_t i = 0; i < face.nodes.size(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          r.local_element(3 * face.nodes[i] + c) -= value_[q][i] * at[c];
    });
    return std::sqrt(dealii::Utilities::MPI::sum(squares, d_.communicator));
  }

  std::vector<SurfaceForces::Tangent> SurfaceForces::tangents(const double t, const Side side, const Vector &u,
                                                              const bool symmetrised) const
  {
    std::vector<Tangent> all;
    for (const Face &face : faces_)
      {
        const unsigned int n = 3 * face.nodes.size();
        all.push_back({face.cell, face.nodes, face.places, dealii::FullMatrix<double>(n, n)});
        const double scale = conditions_[face.condition].scale(t, side);
        for (std::size_t q = 0; q < face.points.size(); ++q)
          if (face.points[q].weight > 0)
            add_tangent(face, q, scale, deformed(face, q, u), all.back().matrix);
        if (symmetrised)
          all.back().matrix.symmetrize();
      }
    return all;
  }

  double SurfaceForces::energy(const double t, const Side side, const Vector &u) const
  {
    const CurrentGhosts current(u);
    double              sum = 0;
    for_each_point(current.vector(), [&](const Face &face, const Condition &condition, const std::size_t q, const Deformed &x) {
      const BoundaryCondition &given = *condition.given;
      const FacePoint         &point = face.points[q];
      if (given.spring)
        sum += point.area / condition.area * given.spring->energy(condition.scale(t, side) - vector3(given.direction) * x.u);
      else if (given.type == BoundaryCondition::Type::foundation)
        sum += point.area / 2 * (given.stiffness * x.u.norm_square() + given.normal_stiffness * std::pow(x.u * point.normal, 2));
    });
    return dealii::Utilities::MPI::sum(sum, d_.communicator);
  }

  double SurfaceForces::power(const double t, const Side side, const Vector &u, const Vector &v) const
  {
    const CurrentGhosts current(u), rate(v);
    double              sum = 0;
    for_each_point(current.vector(), [&](const Face &face, const Condition &condition, const std::size_t q, const Deformed &x) {
      const BoundaryCondition &given = *condition.given;
      const Vector3            at    = force(face, q, condition.scale(t, side), x);
      if (given.type == BoundaryCondition::Type::follower_pressure)
        sum += at * deformed(face, q, rate.vector()).u;
      else if (given.type == BoundaryCondition::Type::tendon && given.profile)
        sum += at * vector3(given.direction) * given.profile->first_derivative(t, side);
    });
    return dealii::Utilities::MPI::sum(sum, d_.communicator);
  }

  Vector3 SurfaceForces::force(const double t, const Side side, const Vector &u, const BoundaryCondition &condition) const
  {
    const CurrentGhosts current(u);
    Vector3             sum;
    for_each_point(current.vector(), [&](const Face &face, const Condition &of, const std::size_t q, const Deformed &x) {
      if (of.given == &condition)
        sum += force(face, q, of.scale(t, side), x);
    });
    return dealii::Utilities::MPI::sum(sum, d_.communicator);
  }
} // namespace myolines
