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

    void interpolate(const MotionFile &file, const NodeSpace &space, State &state)
    {
      std::array<double, 4> furthest{{-1}}; // distance and place
      state.u.zero_out_ghost_values();
      state.v.zero_out_ghost_values();
      for (const auto node : space.nodes().locally_owned_dofs())
        {
          const dealii::Point<3> &x  = space.node_position(node);
          const auto [row, distance] = file.nearest(x);
          furthest                   = std::max(furthest, {{distance, x[0], x[1], x[2]}});
          for (unsigned int c = 0; c < 3; ++c)
            {
              if (file.has_displacement())
                state.u(3 * node + c) = row.displacement[c];
              if (file.has_velocity())
                state.v(3 * node + c) = row.velocity[c];
            }
        }
      for (const auto &other : dealii::Utilities::MPI::all_gather(space.communicator(), furthest))
        furthest = std::max(furthest, other);
      file.check_distance({furthest[1], furthest[2], furthest[3]}, furthest[0]);
    }
  } // namespace

  scene::Schema initial_motion_schema()
  {
    scene::Schema schema("Where the body is and how it moves at the initial time, where no boundary condition says it.");
    add_formulas(schema, displacement, "Displacement [m]");
    add_formulas(schema, velocity, "Velocity [m/s]");
    schema
        .optional_file("file",
                       "Displacements and velocities of places at rest, instead of formulas: a mesh in a format of VTK with the arrays "
                       "displacement and velocity of its points, or a CSV file with a row for every node.")
        .text("file scale", "1", "Unit of length in the file (m, cm, mm, um), or its factor to metres.");
    return schema;
  }

  InitialMotion read_initial_motion(const scene::Node &node, const bool dynamic)
  {
    InitialMotion motion{formulas(node, displacement), formulas(node, velocity), nullptr};
    if (node.has("file"))
      motion.file = std::make_shared<const MotionFile>(node.file("file"), read_unit(node, "file scale"));
    if (motion.file && ((motion.displacement && motion.file->has_displacement()) || (motion.velocity && motion.file->has_velocity())))
      node.refuse("file",
                  std::string("tells ") + (motion.displacement && motion.file->has_displacement() ? "displacements" : "velocities") +
                      ", for which there are formulas too",
                  "one of both");
    if (motion.has_velocity() && !dynamic)
      node.refuse(motion.velocity ? velocity + "x" : "file", "a body without inertia has no initial velocity",
                  "0 in all components, or \"dynamic\" as system/inertia");
    return motion;
  }

  void set_initial_motion(const InitialMotion &motion, const NodeSpace &space, State &state)
  {
    if (motion.file)
      interpolate(*motion.file, space, state);
    interpolate(motion.displacement, space, state.t, state.u);
    interpolate(motion.velocity, space, state.t, state.v);
  }
} // namespace myolines
