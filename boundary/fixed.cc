// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>

namespace myolines
{
  /// u_c = 0.
  BoundaryEntry fixed_condition()
  {
    scene::Schema schema("The face does not move.");
    add_components(schema);
    return {"fixed", MuscleEnd::held, schema, {}, [](const scene::Node &node, BoundaryReading reading) {
              reading.facts.prescribed = read_components(node);
              return std::make_shared<BoundaryCondition>(reading.facts);
            }};
  }
} // namespace myolines
