// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/boundary/boundary.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// The straight line along which a body is measured: muscle length, the part of a force along it, pennation, and the slab that means are
  /// taken over. Its direction is that from the centre of one face to that of another; it reaches from where the body at rest begins in
  /// that direction to where it ends.
  struct LineOfAction
  {
    unsigned int                        from = 0;   ///< face whose mean motion, with that of the next, changes the length
    unsigned int                        to   = 0;   ///< the other face
    dealii::Tensor<1, 3>                direction;  ///< unit vector
    double                              begin  = 0; ///< least X . direction of the body at rest [m]
    double                              length = 0; ///< from there to the greatest [m]
    std::optional<dealii::Tensor<1, 3>> thickness;  ///< unit vector across the line along which thickness is measured, where given

    /// How far @p x is along the line [m].
    double along(const dealii::Point<3> &x) const { return dealii::Tensor<1, 3>(x) * direction - begin; }
    /// Whether @p x is in the slab, 3/8 to 5/8 of the length, thesis (6.2.20); up to @p tolerance parts of the length.
    bool in_slab(const dealii::Point<3> &x, double tolerance) const;
    /// Angle between the line and a direction of either sense, 0 to 90 degrees.
    double angle_to(const dealii::Tensor<1, 3> &a) const;
  };

  /// What a scene says of the line; what it leaves open follows from the body and its conditions, see find_line_of_action().
  struct LineGiven
  {
    /// The faces whose centres it joins, by number.
    struct Faces
    {
      unsigned int from; ///< where the line begins
      unsigned int to;   ///< where it ends
    };
    std::optional<Faces>                faces;     ///< nothing: as find_line_of_action() chooses
    std::optional<dealii::Tensor<1, 3>> direction; ///< unit vector
    std::optional<dealii::Tensor<1, 3>> thickness; ///< unit vector
  };

  /// A line, or why there is none.
  struct LineChoice
  {
    std::optional<LineOfAction> line;     ///< nothing: there is none
    std::string                 why_none; ///< a sentence; empty if there is one
  };

  /// Where nothing is given, bodies of our own are measured along x, as in the thesis. The line of a mesh points from one to another of the
  /// faces that are held, moved or loaded by a dead traction, the two farthest apart if there are more: towards the one that moves; of two
  /// alike, towards the first in the scene.
  LineChoice find_line_of_action(const LineGiven &given, const Geometry &geometry, const std::vector<BoundaryFacts> &boundary);

  /// Declaration of the list `line of action` in the list `system`, and its reading. @throws InputError for faces that the body does not
  /// have, and directions of length zero.
  scene::Schema line_of_action_schema();
  LineGiven     read_line_of_action(const scene::Node &system, const Geometry &geometry); ///< Reads that list.
} // namespace myolines
