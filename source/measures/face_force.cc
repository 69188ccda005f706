// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/measures/face_force.h>
#include <myolines/muscle3d/point_states.h>

#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

namespace myolines
{
  namespace
  {
    /// Number of the Gauss point of the cell nearest to each point of the face rule on @p face.
    std::vector<int> nearest_points(const Element &element, const dealii::Quadrature<2> &rule, const unsigned int face)
    {
      const dealii::Quadrature<3> on_face = dealii::QProjector<3>::project_to_face(dealii::ReferenceCells::get_hypercube<3>(), rule, face);
      const auto                  nearest = [&](const double x) {
        int best = 0;
        for (int q = 1; q < element.n_points_1d; ++q)
          if (std::abs(element.point[q] - x) < std::abs(element.point[best] - x))
            best = q;
        return best;
      };
      std::vector<int> numbers;
      for (const dealii::Point<3> &x : on_face.get_points())
        numbers.push_back(nearest(x[0]) + element.n_points_1d * (nearest(x[1]) + element.n_points_1d * nearest(x[2])));
      return numbers;
    }
  } // namespace

  Parts<Vector3> interior_point_force(const Muscle3dSystem &system, const State &state, const unsigned int face)
  {
    PointStates                   states(system, state);
    const Muscle3dDiscretisation &d          = states.discretisation();
    const Activation              activation = system.activation(state.t);
    const dealii::QGauss<2>       rule(d.element.n_points_1d);
    dealii::FEFaceValues<3>       values(d.space->nodes().get_fe(), rule, dealii::update_normal_vectors | dealii::update_JxW_values);

    Parts<Vector3> force;
    for (unsigned int b = 0; b < d.batches->n_owned_batches(); ++b)
      {
        bool evaluated = false;
        for (unsigned int lane = 0; lane < d.batches->n_filled(b); ++lane)
          for (const unsigned int f : d.batches->cell(b, lane)->face_indices())
            if (const auto &cell = d.batches->cell(b, lane); cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == face)
              {
                if (!evaluated)
                  states.evaluate(b);
                evaluated = true;
                values.reinit(cell, f);
                const std::vector<int> nearest = nearest_points(d.element, rule, f);
                for (unsigned int q = 0; q < nearest.size(); ++q)
                  {
                    const Parts<Matrix3> P    = stress_parts(system.parameters(), activation, states.point(nearest[q], lane));
                    const Vector3        area = values.normal_vector(q) * values.JxW(q);
                    force.for_each(P, [&](Vector3 &to, const Matrix3 &stress) { to += stress * area; });
                  }
              }
      }
    force.laws.resize(system.parameters().law_parts().size());
    force.for_each([&](Vector3 &part) {
      for (unsigned int c = 0; c < 3; ++c)
        part[c] = dealii::Utilities::MPI::sum(part[c], d.communicator);
    });
    return force;
  }
} // namespace myolines
