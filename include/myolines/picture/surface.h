// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/picture/body.h>

#include <optional>
#include <vector>

namespace myolines::picture
{
  /// Points of a face, going round; counter-clockwise seen from outside.
  using Quad = Body::Face;

  /// The surface of a body, and its edges.
  struct Surface
  {
    /// An edge of one or two faces.
    struct Edge
    {
      std::size_t         a;           ///< point at one end
      std::size_t         b;           ///< point at the other
      std::array<Quad, 2> between;     ///< the faces that meet there
      bool                open = true; ///< only the first is there
    };

    std::vector<Quad> quads; ///< faces
    std::vector<Edge> edges; ///< of them, each once
  };

  /// Faces that one cell alone has, or those of a surface that a run wrote alone. Points whose places at rest are equal up to rounding are
  /// one.
  Surface surface_of(const Body &body);

  /// Normal of a face, outwards. Not normalised.
  Vec normal(const Quad &quad, const std::vector<Vec> &places);

  /// A straight piece of a line.
  using Segment = std::array<Vec, 2>;

  /// What draws the shape of a body whose points are at @p places, seen along @p direction: edges where the surface bends by more than 40
  /// degrees, and those between faces that are seen and faces that are not.
  std::vector<Segment> outline(const Surface &surface, const std::vector<Vec> &places, const Vec &direction);

  /// A flat piece of what is seen.
  struct Polygon
  {
    std::vector<Vec>    corners; ///< going round
    std::vector<double> values;  ///< of the field, at the corners
    Vec                 normal;  ///< outwards, unit
  };

  /// Takes away the part of a body beyond a plane that is fixed in it: points whose coordinate @p axis at rest is above @p place [m].
  struct Cut
  {
    unsigned int axis;  ///< 0, 1 or 2
    double       place; ///< [m]
  };

  /// What is seen of @p body from outside: its surface or, with a @p cut, what is left of it and the face of the cut.
  /// @p values: one of each point.
  std::vector<Polygon> polygons(const Body &body, const Surface &surface, const std::vector<double> &values, const std::optional<Cut> &cut);
} // namespace myolines::picture
