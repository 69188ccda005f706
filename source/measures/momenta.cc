// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/measures/momenta.h>
#include <myolines/muscle3d/point_states.h>

namespace myolines
{
  Momenta measure_momenta(const Muscle3dSystem &system, const State &state)
  {
    const Element &element = system.discretisation().element;
    const MPI_Comm all     = system.discretisation().communicator;
    Momenta        m;
    Vector3        about_origin;
    PointStates(system, state).for_each([&](const NodeSpace::Cell &cell, const int q, const PointState &p) {
      const double  mass = p.JxW * p.material[material_density];
      const Vector3 x    = point_position(element, cell, q) + p.displacement;
      m.mass += mass;
      m.centre += mass * x;
      m.momentum += mass * p.velocity;
      about_origin += mass * cross_product_3d(x, p.velocity);
    });
    m.mass             = dealii::Utilities::MPI::sum(m.mass, all);
    m.centre           = dealii::Utilities::MPI::sum(m.centre, all) / m.mass;
    m.momentum         = dealii::Utilities::MPI::sum(m.momentum, all);
    m.angular_momentum = dealii::Utilities::MPI::sum(about_origin, all) - cross_product_3d(m.centre, m.momentum);
    return m;
  }
} // namespace myolines
