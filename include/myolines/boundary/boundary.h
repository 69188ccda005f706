// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/registry.h>
#include <myolines/body/geometry.h>
#include <myolines/boundary/boundary_condition.h>
#include <myolines/scene/scene.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  struct LineGiven;
  struct LineChoice;

  using BoundaryConditions = std::vector<std::shared_ptr<const BoundaryCondition>>; ///< in the order of the scene

  /// What the making of a condition may look at.
  struct BoundaryReading
  {
    BoundaryFacts     facts;    ///< name, face, place in the scene, end
    const Geometry   &geometry; ///< the body
    const LineChoice &line;     ///< of action
    bool              dynamic;  ///< whether the system has velocities
  };

  /// A kind of condition: what its file in `boundary/` gives to the list of all.
  struct BoundaryEntry
  {
    std::string              name;    ///< `type` in a scene
    MuscleEnd                end;     ///< of the faces that have one
    scene::Schema            schema;  ///< of its parameters, beside face and type
    std::vector<std::string> example; ///< "force=2": with them there is one that does all it can, on any face of any body

    std::function<std::shared_ptr<const BoundaryCondition>(const scene::Node &, BoundaryReading)> make; ///< of its list. @throws InputError
  };

  inline const std::string &name_of(const BoundaryEntry &entry) { return entry.name; } ///< For Registry.

  /// All kinds, in the order of `boundary/list.def`, then those of plug-ins.
  Registry<BoundaryEntry> &boundary_registry();
  /// The kind of that name. @throws std::out_of_range
  const BoundaryEntry &boundary_entry(const std::string &name);

  /// Declaration of the list `boundary`, and its reading. @throws InputError for what ranges cannot express (unknown face or
  /// component, a direction of length zero, two conditions that prescribe the same component of the same face, malformed formulas).
  /// @p given: what the scene says of the line of action, from which directions that it leaves open follow for a mesh.
  scene::Schema boundary_schema();
  /// Reads that list.
  BoundaryConditions read_boundary(const scene::Node &node, const Geometry &geometry, const LineGiven &given, bool dynamic);

  std::vector<BoundaryFacts> facts_of(const BoundaryConditions &conditions); ///< Of each, in the same order.

  /// @throws InputError if @p condition acts on no area.
  void refuse_empty(const BoundaryFacts &condition, double area);
} // namespace myolines
