// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/current_ghosts.h>

#include <myolines/muscle3d/surface_forces.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <map>

namespace myolines
{
  SurfaceForces::SurfaceForces(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation)
    : d_(discretisation)
    , n1_(discretisation.element.n_nodes_1d)
    , weights_(dealii::QGauss<2>(discretisation.element.n_points_1d).get_weights())
  {
    BoundaryConditions conditions;
    for (const auto &condition : parameters.boundary)
      if (const BoundaryFacts &facts = condition->facts(); facts.loads || facts.pushes)
        {
          conditions.push_back(condition);
          has_[loading] = has_[loading] || facts.loads;
          has_[pushing] = has_[pushing] || facts.pushes;
          rates_        = rates_ || facts.rates;
        }
    if (conditions.empty())
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
          for (const auto &condition : conditions)
            if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == condition->facts().face)
              add_face(cell, f, *condition);
    find_areas(conditions);
    find_potentials(parameters);
  }

  /// Tangents run along the two axes after that across the face, so that their product points along that one.
  void SurfaceForces::add_face(const NodeSpace::Cell &cell, const unsigned int f, const BoundaryCondition &condition)
  {
    const NodeSpace                             &space = *d_.space;
    std::vector<dealii::types::global_dof_index> numbers;
    space.cell_nodes(cell, numbers);
    Face               face{cell, &condition, f % 2 == 1 ? 1. : -1., {}, {}, {}};
    const unsigned int axis      = f / 2;
    const int          stride[3] = {1, n1_, n1_ * n1_};
    for (int i2 = 0; i2 < n1_; ++i2)
      for (int i1 = 0; i1 < n1_; ++i1)
        {
          face.places.push_back((f % 2 == 1 ? n1_ - 1 : 0) * stride[axis] + i1 * stride[(axis + 1) % 3] + i2 * stride[(axis + 2) % 3]);
          face.nodes.push_back(space.partitioner().global_to_local(3 * numbers[face.places.back()]) / 3);
        }
    for (std::size_t q = 0; q < weights_.size(); ++q)
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
        const bool    inside  = condition.facts().part.contains(dealii::Point<3>(X));
        face.points.push_back({dealii::Point<3>(X), product / product.norm(), inside ? weights_[q] * product.norm() : 0.});
      }
    faces_.push_back(std::move(face));
  }

  void SurfaceForces::find_areas(const BoundaryConditions &conditions)
  {
    std::map<const BoundaryCondition *, double> areas;
    for (const Face &face : faces_)
      if (face.cell->is_locally_owned())
        for (const FacePoint &point : face.points)
          areas[face.condition] += point.area;
    for (const auto &condition : conditions)
      {
        double &area = areas[condition.get()];
        area         = dealii::Utilities::MPI::sum(area, d_.communicator);
        refuse_empty(condition->facts(), area);
      }
    for (Face &face : faces_)
      for (FacePoint &point : face.points)
        point.face_area = areas[face.condition];
  }

  std::array<Vector3, 2> SurfaceForces::edges(const Face &face, const std::size_t q, const Vector &u) const
  {
    const NodeSpace       &space = *d_.space;
    std::array<Vector3, 2> x;
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      {
        const double *at = u.begin() + 3 * face.nodes[i];
        const Vector3 xi = Vector3({at[0], at[1], at[2]}) + space.node_position(space.partitioner().local_to_global(3 * face.nodes[i]) / 3);
        x[0] += d1_[q][i] * xi;
        x[1] += d2_[q][i] * xi;
      }
    return x;
  }

  FaceMotion SurfaceForces::motion(const Face &face, const std::size_t q, const Point &point, const bool velocity) const
  {
    const BoundaryFacts &facts = face.condition->facts();
    const auto           value = [&](const Vector &x) {
      Vector3 sum;
      for (std::size_t i = 0; i < face.nodes.size(); ++i)
        {
          const double *at = x.begin() + 3 * face.nodes[i];
          sum += value_[q][i] * Vector3({at[0], at[1], at[2]});
        }
      return sum;
    };
    FaceMotion x;
    x.u = value(point.u);
    if (facts.rates || velocity)
      x.v = value(point.v);
    if (facts.follows)
      {
        const auto [x1, x2] = edges(face, q, point.u);
        x.area              = weights_[q] * face.sign * cross_product_3d(x1, x2);
      }
    return x;
  }

  /// The mean of the product x1 x x2 of edges that move evenly is (b1 x b2 + e1 x e2)/3 + (b1 x e2 + e1 x b2)/6.
  FaceStep SurfaceForces::step(const Face &face, const std::size_t q, const Point &point) const
  {
    const Point begin{point.t, point.side, *point.before, point.v, point.a};
    FaceStep    x{motion(face, q, begin), motion(face, q, point), {}};
    x.middle.u = (x.begin.u + x.end.u) / 2;
    x.middle.v = x.end.v;
    if (!face.condition->facts().follows)
      return x;
    const auto [b1, b2] = edges(face, q, *point.before);
    const auto [e1, e2] = edges(face, q, point.u);
    x.middle.area = (x.begin.area + x.end.area) / 3 + weights_[q] * face.sign / 6 * (cross_product_3d(b1, e2) + cross_product_3d(e1, b2));
    return x;
  }

  Vector3 SurfaceForces::force(const Face &face, const std::size_t q, const Point &point) const
  {
    const BoundaryCondition &condition = *face.condition;
    if (point.before == nullptr)
      return condition.force(point.t, point.side, face.points[q], motion(face, q, point));
    const FaceStep x   = step(face, q, point);
    Vector3        sum = condition.force_of_step(point.t, point.side, face.points[q], x);
    if (point.dissipation != 0 && condition.facts().supports)
      sum += point.dissipation / 2 *
             (condition.force(point.t, point.side, face.points[q], x.end) - condition.force(point.t, point.side, face.points[q], x.begin));
    return sum;
  }

  ForceTangent SurfaceForces::tangent(const Face &face, const std::size_t q, const Point &point) const
  {
    const BoundaryCondition &condition = *face.condition;
    if (point.before == nullptr)
      return condition.tangent(point.t, point.side, face.points[q], motion(face, q, point));
    const FaceStep x = step(face, q, point);
    ForceTangent   k = condition.tangent_of_step(point.t, point.side, face.points[q], x);
    if (point.dissipation != 0 && condition.facts().supports)
      k.by_u += point.dissipation / 2 * condition.tangent(point.t, point.side, face.points[q], x.end).by_u;
    return k;
  }

  void SurfaceForces::add_tangent(const Face &face, const std::size_t q, const Point &point, Tangent &tangent) const
  {
    const BoundaryFacts &facts = face.condition->facts();
    const ForceTangent   k     = this->tangent(face, q, point);
    Matrix3              by_x1, by_x2; // d(area) = w (dx1 x x2 + x1 x dx2)
    if (facts.follows)
      {
        auto [x1, x2] = edges(face, q, point.u);
        if (point.before != nullptr) // derivatives of the mean area by the end
          {
            const auto [b1, b2] = edges(face, q, *point.before);
            x1                  = x1 / 3 + b1 / 6;
            x2                  = x2 / 3 + b2 / 6;
          }
        for (unsigned int c = 0; c < 3; ++c)
          {
            Vector3 unit;
            unit[c]             = weights_[q] * face.sign;
            const Vector3 first = k.by_area * cross_product_3d(unit, x2), second = k.by_area * cross_product_3d(x1, unit);
            for (unsigned int a = 0; a < 3; ++a)
              {
                by_x1[a][c] = first[a];
                by_x2[a][c] = second[a];
              }
          }
      }
    const auto add = [](dealii::FullMatrix<double> &K, const std::size_t i, const std::size_t j, const Matrix3 &block) {
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int c = 0; c < 3; ++c)
          K(3 * i + a, 3 * j + c) += block[a][c];
    };
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      for (std::size_t j = 0; j < face.nodes.size(); ++j)
        {
          Matrix3 block = value_[q][j] * k.by_u;
          if (facts.follows)
            block += d1_[q][j] * by_x1 + d2_[q][j] * by_x2;
          add(tangent.stiffness, i, j, value_[q][i] * block);
          if (facts.rates)
            add(tangent.damping, i, j, value_[q][i] * value_[q][j] * k.by_v);
        }
  }

  template <typename Visitor>
  void SurfaceForces::for_each_point(const int kind, const Visitor &visit) const
  {
    for (const Face &face : faces_)
      if (face.cell->is_locally_owned() && (kind == loading ? face.condition->facts().loads : face.condition->facts().pushes))
        for (std::size_t q = 0; q < face.points.size(); ++q)
          if (face.points[q].area > 0)
            visit(face, q);
  }

  double SurfaceForces::subtract(const Point &point, Vector &r) const
  {
    double squares = 0;
    for_each_point(pushing, [&](const Face &face, const std::size_t q) {
      const Vector3 at = force(face, q, point);
      squares += at * at;
      for (std::size_t i = 0; i < face.nodes.size(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          r.local_element(3 * face.nodes[i] + c) -= value_[q][i] * at[c];
    });
    return std::sqrt(dealii::Utilities::MPI::sum(squares, d_.communicator));
  }

  void SurfaceForces::add_loads(const double t, const Side side, Vector &f) const
  {
    for_each_point(loading, [&](const Face &face, const std::size_t q) {
      const Vector3 at = face.condition->load(t, side, face.points[q]);
      for (std::size_t i = 0; i < face.nodes.size(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          f.local_element(3 * face.nodes[i] + c) += at[c] * value_[q][i];
    });
  }

  /// Of ghost cells as well: owners of rows fill them without communication, as with the cells themselves.
  std::vector<SurfaceForces::Tangent> SurfaceForces::tangents(const Point &point, const bool symmetrised) const
  {
    std::vector<Tangent> all;
    for (const Face &face : faces_)
      if (const BoundaryFacts &facts = face.condition->facts(); facts.pushes)
        {
          const unsigned int n = 3 * face.nodes.size();
          all.push_back({face.cell, face.nodes, face.places, dealii::FullMatrix<double>(n, n), dealii::FullMatrix<double>()});
          if (facts.rates)
            all.back().damping.reinit(n, n);
          for (std::size_t q = 0; q < face.points.size(); ++q)
            if (face.points[q].area > 0)
              add_tangent(face, q, point, all.back());
          if (symmetrised)
            all.back().stiffness.symmetrize();
        }
    return all;
  }

  SurfaceForces::Work SurfaceForces::work(const Point &at, const BoundaryCondition *of) const
  {
    const CurrentGhosts u(at.u), v(at.v);
    const Point         point{at.t, at.side, u.vector(), v.vector(), at.a};
    std::vector<double> sums(3);
    for_each_point(pushing, [&](const Face &face, const std::size_t q) {
      if (of != nullptr && of != face.condition)
        return;
      const BoundaryCondition &condition = *face.condition;
      const FaceMotion         x         = motion(face, q, point, true);
      sums[0] += condition.energy(point.t, point.side, face.points[q], x);
      if (has_potential(condition)) // of the volume x.n/3 dA below the face, beside that at rest
        sums[0] += *condition.constant_pressure() / 3 *
                   ((face.points[q].place + x.u) * x.area - Vector3(face.points[q].place) * face.points[q].normal * face.points[q].area);
      else
        sums[1] += condition.power(point.t, point.side, face.points[q], x);
      sums[2] += condition.dissipation(point.t, point.side, face.points[q], x);
    });
    dealii::Utilities::MPI::sum(sums, d_.communicator, sums);
    return {sums[0], sums[1], sums[2]};
  }

  double SurfaceForces::power_on_body(const Point &at, const BoundaryCondition &condition) const
  {
    const CurrentGhosts u(at.u), v(at.v);
    const Point         point{at.t, at.side, u.vector(), v.vector(), at.a};
    double              sum = 0;
    for_each_point(loading, [&](const Face &face, const std::size_t q) {
      if (face.condition == &condition)
        sum += condition.load(point.t, point.side, face.points[q]) * motion(face, q, point, true).v;
    });
    for_each_point(pushing, [&](const Face &face, const std::size_t q) {
      if (face.condition != &condition)
        return;
      const FaceMotion x = motion(face, q, point, true);
      sum += condition.force(point.t, point.side, face.points[q], x) * x.v;
    });
    return dealii::Utilities::MPI::sum(sum, d_.communicator);
  }

  Vector3 SurfaceForces::force(const Point &at, const BoundaryCondition &condition) const
  {
    const CurrentGhosts u(at.u), v(at.v);
    const Point         point{at.t, at.side, u.vector(), v.vector(), at.a};
    Vector3             sum;
    for_each_point(pushing, [&](const Face &face, const std::size_t q) {
      if (face.condition == &condition)
        sum += condition.force(point.t, point.side, face.points[q], motion(face, q, point));
    });
    return dealii::Utilities::MPI::sum(sum, d_.communicator);
  }

  Vector3 SurfaceForces::load(const double t, const Side side, const BoundaryCondition &condition) const
  {
    Vector3 sum;
    for_each_point(loading, [&](const Face &face, const std::size_t q) {
      if (face.condition == &condition)
        sum += condition.load(t, side, face.points[q]);
    });
    return dealii::Utilities::MPI::sum(sum, d_.communicator);
  }
} // namespace myolines
