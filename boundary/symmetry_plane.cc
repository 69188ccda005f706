// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/boundary/boundary_entries.h>
#include <myolines/fem/node_space.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    /// Unit normal of the plane face of a condition. @throws InputError if it is none.
    Vector3 normal_of_plane(const BoundaryFacts &condition, const NodeSpace &space)
    {
      dealii::FEFaceValues<3> values(space.nodes().get_fe(), dealii::QGauss<2>(2),
                                     dealii::update_normal_vectors | dealii::update_JxW_values);
      Vector3                 sum;
      double                  area = 0;
      for (const NodeSpace::Cell &cell : space.nodes().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == condition.face)
              {
                values.reinit(cell, f);
                for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                  {
                    sum += values.JxW(q) * values.normal_vector(q);
                    area += values.JxW(q);
                  }
              }
      sum  = dealii::Utilities::MPI::sum(sum, space.communicator());
      area = dealii::Utilities::MPI::sum(area, space.communicator());
      // All normals are one exactly where their mean has length one; the difference is of second order.
      if (!(sum.norm() > (1 - 1e-12) * area))
        throw InputError(InputProblem{condition.where, "the face of symmetry plane \"" + condition.name + "\" is not plane", "a plane face",
                                      "one condition for each plane part, by faces of their own"});
      constexpr double negligible = 1e-10; // beside 1
      for (unsigned int c = 0; c < 3; ++c)
        if (std::abs(sum[c]) < negligible * area)
          sum[c] = 0; // so that planes along the axes tie nothing
      return sum / sum.norm();
    }

    /// u.N = 0 on a plane face.
    class SymmetryPlane : public BoundaryCondition
    {
    public:
      explicit SymmetryPlane(const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
      {
        facts_.ties     = true;
        facts_.says_tie = "is a symmetry plane";
      }

      std::vector<Tie> ties(const NodeSpace &space) const override { return {{normal_of_plane(facts_, space)}}; }
    };
  } // namespace

  BoundaryEntry symmetry_plane_condition()
  {
    const scene::Schema schema(
        "The face, a plane of any direction, moves only within its plane: the body goes on behind it as in a mirror.");
    return {"symmetry plane", MuscleEnd::none, schema, {}, [](const scene::Node &, const BoundaryReading &reading) {
              return std::make_shared<SymmetryPlane>(reading);
            }};
  }
} // namespace myolines
