// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/body/entries.h>
#include <myolines/boundary/line_of_action.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    using scene::Node;
    using Vector3 = dealii::Tensor<1, 3>;

    using Faces = LineGiven::Faces;

    const char *const line_list = "line of action";

    Vector3 as_tensor(const std::array<double, 3> &x) { return Vector3({x[0], x[1], x[2]}); }

    /// A face with such a condition; moved if one of them moves it.
    struct End
    {
      unsigned int face;
      bool         moved;
    };

    std::vector<End> ends_of(const std::vector<BoundaryFacts> &boundary)
    {
      std::vector<End> ends;
      for (const BoundaryFacts &condition : boundary)
        if (condition.end != MuscleEnd::none)
          {
            const bool moved = condition.end == MuscleEnd::moved;
            const auto known = std::find_if(ends.begin(), ends.end(), [&](const End &end) { return end.face == condition.face; });
            if (known == ends.end())
              ends.push_back({condition.face, moved});
            else
              known->moved = known->moved || moved;
          }
      return ends;
    }

    /// The two ends farthest apart; none if there are not two, or if others are as far apart.
    std::optional<Faces> farthest(const std::vector<End> &ends, const Geometry &geometry)
    {
      std::optional<Faces> best;
      double               distance = 0, next = 0;
      for (std::size_t i = 0; i < ends.size(); ++i)
        for (std::size_t j = i + 1; j < ends.size(); ++j)
          {
            const double d = face_centre(geometry, ends[i].face).distance(face_centre(geometry, ends[j].face));
            if (d > distance)
              {
                next     = distance;
                distance = d;
                best     = ends[j].moved && !ends[i].moved ? Faces{ends[i].face, ends[j].face} : Faces{ends[j].face, ends[i].face};
              }
            else
              next = std::max(next, d);
          }
      constexpr double alike = 1e-6;
      if (next > (1 - alike) * distance)
        return std::nullopt;
      return best;
    }

    std::optional<Faces> read_faces(const Node &line, const Geometry &geometry)
    {
      const bool from = line.has("from"), to = line.has("to");
      if (!from && !to)
        return std::nullopt;
      if (from != to)
        line.refuse(from ? "to" : "from", "is missing, where the other end is given", "the names of two faces");
      const Faces faces{read_face(line, "from", geometry), read_face(line, "to", geometry)};
      if (faces.from == faces.to)
        line.refuse("to", "is the face where the line begins, too", "another face");
      return faces;
    }

    /// From where the body begins along the direction to where it ends.
    void measure(LineOfAction &line, const Geometry &geometry)
    {
      double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
      for (const dealii::Point<3> &x : corners(geometry))
        {
          const double s = Vector3(x) * line.direction;
          low            = std::min(low, s);
          high           = std::max(high, s);
        }
      line.begin  = low;
      line.length = high - low;
    }

    /// The part of @p v across the unit vector @p along, over its length; nothing where it is along.
    std::optional<Vector3> across(const Vector3 &v, const Vector3 &along)
    {
      const Vector3 part = v - (v * along) * along;
      if (part.norm() < 1e-3)
        return std::nullopt;
      return part / part.norm();
    }
  } // namespace

  bool LineOfAction::in_slab(const dealii::Point<3> &x, const double tolerance) const
  {
    const double s = along(x), slack = tolerance * length;
    return s >= 3. / 8 * length - slack && s <= 5. / 8 * length + slack;
  }

  double LineOfAction::angle_to(const Vector3 &a) const
  {
    return std::atan2(cross_product_3d(direction, a).norm(), std::abs(direction * a)) * 180 / dealii::numbers::PI;
  }

  scene::Schema line_of_action_schema()
  {
    scene::Schema schema(
        "The line along which the body is measured. Default: x for a block and the idealised gastrocnemius; for a mesh from the "
        "centre of one held, moved or loaded face to that of another.");
    schema.optional_text("from", "Face where the line begins, by a name of the geometry, for example \"x-\".")
        .optional_text("to", "Face where it ends, for example \"x+\".")
        .optional_text("direction", "Direction of the line, three numbers, for example \"1 0 0\"; default: from centre to centre.")
        .optional_text("thickness",
                       "Direction in which thickness is measured, for example \"0 0 1\", width being across it; default: the direction in "
                       "which the fibres of the slab lean from the line.");
    return schema;
  }

  LineChoice find_line_of_action(const LineGiven &given, const Geometry &geometry, const std::vector<BoundaryFacts> &boundary)
  {
    const bool           ours  = !geometry.mesh;
    std::optional<Faces> faces = given.faces;
    if (!faces)
      faces = ours ? Faces{0, 1} : farthest(ends_of(boundary), geometry);
    if (!faces)
      return {std::nullopt, "the scene does not hold, move or load two faces, farther from each other than any others"};

    LineOfAction line;
    line.from           = faces->from;
    line.to             = faces->to;
    const Vector3 span  = face_centre(geometry, faces->to) - face_centre(geometry, faces->from);
    const bool    apart = span.norm() > 1e-9 * geometry.size[0];
    if (given.direction)
      line.direction = *given.direction;
    else if (ours && !given.faces)
      line.direction = Vector3({1, 0, 0});
    else if (apart)
      line.direction = span / span.norm();
    else
      return {std::nullopt, "the centres of the two faces coincide"};
    if (given.thickness)
      {
        line.thickness = across(*given.thickness, line.direction);
        if (!line.thickness)
          return {std::nullopt, "the direction of the thickness is along it"};
      }
    else if (ours)
      line.thickness = across(Vector3({0, 0, 1}), line.direction);
    measure(line, geometry);
    return {line, ""};
  }

  LineGiven read_line_of_action(const Node &system, const Geometry &geometry)
  {
    LineGiven given;
    if (!system.has(line_list))
      return given;
    const Node &list = system.section(line_list);
    given.faces      = read_faces(list, geometry);
    if (list.has("direction"))
      given.direction = as_tensor(read_direction(list, "direction"));
    if (list.has("thickness"))
      given.thickness = as_tensor(read_direction(list, "thickness"));
    return given;
  }
} // namespace myolines
