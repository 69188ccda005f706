// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/rigid_body_modes.h>

namespace myolines
{
  std::vector<Vector> rigid_body_modes(const NodeSpace &space, const Constraints &constraints)
  {
    std::vector<Vector>   modes(6, space.make_vector());
    const auto           &owned = space.nodes().locally_owned_dofs();
    std::array<double, 3> middle{};
    for (const auto node : owned)
      for (unsigned int c = 0; c < 3; ++c)
        middle[c] += space.node_position(node)[c];
    for (double &m : middle)
      m = dealii::Utilities::MPI::sum(m, space.communicator()) / double(owned.size());
    for (const auto node : owned)
      {
        const dealii::Point<3> &x             = space.node_position(node);
        const double            r[3]          = {x[0] - middle[0], x[1] - middle[1], x[2] - middle[2]};
        const double            entries[6][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -r[2], r[1]}, {r[2], 0, -r[0]}, {-r[1], r[0], 0}};
        for (unsigned int mode = 0; mode < 6; ++mode)
          for (unsigned int c = 0; c < 3; ++c)
            if (!constraints.is_constrained(3 * node + c))
              modes[mode](3 * node + c) = entries[mode][c];
      }
    return modes;
  }
} // namespace myolines
