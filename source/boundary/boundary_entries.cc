// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>
#include <myolines/boundary/line_of_action.h>

#include <algorithm>
#include <sstream>

namespace myolines
{
  using scene::Node;
  using scene::Range;
  using scene::Schema;

  void add_components(Schema &schema)
  {
    schema.text("components", "x y z", "Which components are prescribed, any of x y z; the others are free.");
  }

  std::array<bool, 3> read_components(const Node &node)
  {
    std::array<bool, 3> chosen{{false, false, false}};
    std::istringstream  words(node.text("components"));
    for (std::string word; words >> word;)
      {
        const auto axis = std::find(axes.begin(), axes.end(), word);
        if (axis == axes.end())
          node.refuse("components", "unknown component \"" + word + "\"", "any of x y z, separated by spaces");
        chosen[axis - axes.begin()] = true;
      }
    if (!chosen[0] && !chosen[1] && !chosen[2])
      node.refuse("components", "no component is named", "any of x y z, separated by spaces");
    return chosen;
  }

  void add_direction(Schema &schema, const std::string &doc)
  {
    schema.optional_text(
        "direction",
        doc + ", for example \"1 0 0\"; normalised. Default: x for a block and the idealised gastrocnemius; of a mesh the line of "
              "action, towards this face from the other end.");
  }

  Vector3 read_direction_of(const Node &node, const BoundaryReading &reading)
  {
    if (node.has("direction"))
      {
        const std::array<double, 3> given = read_direction(node, "direction");
        return Vector3({given[0], given[1], given[2]});
      }
    if (!reading.geometry.mesh)
      return Vector3({1, 0, 0});
    const auto &line = reading.line.line; // the axes of a mesh mean nothing
    if (!line || (reading.facts.face != line->from && reading.facts.face != line->to))
      node.refuse("direction", "is missing, and the face is at no end of a line of action from which it could follow",
                  "three numbers separated by spaces", "from the other end of the muscle towards this one, as a rule");
    return (reading.facts.face == line->to ? 1. : -1.) * line->direction;
  }

  void add_box(Schema &schema)
  {
    for (const char *axis : axes)
      for (const char *end : {" from", " to"})
        schema.optional_number(axis + std::string(end), "m", Range::any(),
                               "The load acts only on this part of the face, decided point by point; default: all of it.");
  }

  Box read_box(const Node &node)
  {
    Box box;
    for (unsigned int c = 0; c < 3; ++c)
      {
        const std::string from = axes[c] + std::string(" from"), to = axes[c] + std::string(" to");
        box.low[c]  = node.has(from) ? node.number(from) : -Box::infinity;
        box.high[c] = node.has(to) ? node.number(to) : Box::infinity;
        if (!(box.low[c] < box.high[c]))
          node.refuse(to, "the loaded part is empty", "more than \"" + from + "\"");
      }
    return box;
  }

  void ProfiledLoad::add(Schema &schema, const std::string &name, const std::string &unit, const std::string &doc)
  {
    schema.number(name, std::nullopt, unit, Range::any(), doc).optional_section("profile", drive_schema("factor of the " + name, "-"));
  }

  ProfiledLoad::ProfiledLoad(const Node &node, const std::string &name)
    : size_(node.number(name))
  {
    if (node.has("profile"))
      profile_ = make_drive(node.section("profile"));
  }

  std::vector<const Drive *> ProfiledLoad::drives() const
  {
    return profile_ ? std::vector<const Drive *>{profile_.get()} : std::vector<const Drive *>{};
  }
} // namespace myolines
