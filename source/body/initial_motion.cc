// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/body/entries.h>
#include <myolines/body/initial_motion.h>
#include <myolines/scene/formula.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    const std::string displacement = "displacement ", velocity = "velocity ";

    /// The formulas, or none where all are left at "0".
    std::optional<std::array<std::string, 3>> formulas(const scene::Node &node, const std::string &prefix)
    {
      const std::array<std::string, 3> texts = read_formulas(node, prefix);
      if (std::all_of(texts.begin(), texts.end(), [](const std::string &text) { return text == "0"; }))
        return std::nullopt;
      return texts;
    }

    void interpolate(const std::optional<std::array<std::string, 3>> &texts, const NodeSpace &space, const double t, Vector &x)
    {
      if (!texts)
        return;
      const VectorFormula formula(*texts);
      x.zero_out_ghost_values();
      for (const auto node : space.nodes().locally_owned_dofs())
        for (unsigned int c = 0; c < 3; ++c)
          x(3 * node + c) = formula(c, space.node_position(node), t);
    }
  } // namespace

  scene::Schema initial_motion_schema()
  {
    scene::Schema schema("Where the body is and how it moves at the initial time, where no boundary condition says it.");
    add_formulas(schema, displacement, "Displacement [m]");
    add_formulas(schema, velocity, "Velocity [m/s]");
    return schema;
  }

  InitialMotion read_initial_motion(const scene::Node &node, const bool dynamic)
  {
    const InitialMotion motion{formulas(node, displacement), formulas(node, velocity)};
    if (motion.velocity && !dynamic)
      node.refuse(velocity + "x", "a body without inertia has no initial velocity",
                  "0 in all components, or \"dynamic\" as system/inertia");
    return motion;
  }

  void set_initial_motion(const InitialMotion &motion, const NodeSpace &space, State &state)
  {
    interpolate(motion.displacement, space, state.t, state.u);
    interpolate(motion.velocity, space, state.t, state.v);
  }
} // namespace myolines
