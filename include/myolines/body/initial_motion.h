// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/body/motion_file.h>
#include <myolines/fem/node_space.h>
#include <myolines/scene/scene.h>
#include <myolines/system/point.h>

#include <array>
#include <optional>
#include <string>

namespace myolines
{
  /// Where the body is and how it moves at the initial time, as far as boundary conditions do not say it: formulas of the place at rest, or
  /// what a file says of it, interpolated at the nodes.
  struct InitialMotion
  {
    std::optional<std::array<std::string, 3>> displacement; ///< [m], formulas of x, y, z, t; nullopt: 0
    std::optional<std::array<std::string, 3>> velocity;     ///< [m/s], likewise
    std::shared_ptr<const MotionFile>         file;         ///< of what has no formulas, or null

    bool has_displacement() const { return displacement || (file && file->has_displacement()); } ///< Whether it gives displacements.
    bool has_velocity() const { return velocity || (file && file->has_velocity()); }             ///< Whether it gives velocities.
  };

  /// Declaration of the list `initial motion`, and its reading. @throws InputError for malformed formulas and files, for a quantity in
  /// both, and for velocities of a body without inertia.
  scene::Schema initial_motion_schema();
  InitialMotion read_initial_motion(const scene::Node &node, bool dynamic); ///< Reads that list.

  /// u and v of the nodes of this rank at time state.t. @throws InputError for nodes of which the file says nothing, on all ranks.
  void set_initial_motion(const InitialMotion &motion, const NodeSpace &space, State &state);
} // namespace myolines
