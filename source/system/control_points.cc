// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/input_text.h>
#include <myolines/scene/numbers.h>
#include <myolines/system/control_points.h>

#include <sstream>

namespace myolines
{
  scene::Schema control_points_schema(const std::string &unit, const std::string &doc)
  {
    scene::Schema schema(doc);
    schema.optional_text("points", "Control points \"t value; t value; ...\", times [s] ascending. Either these or a file.")
        .optional_file("file", "Control points, one \"t value\" a line; lines that begin with # are skipped.")
        .number("scale", 1, "-", scene::Range::any(), "Multiplies the values of the control points [" + unit + "].");
    return schema;
  }

  namespace
  {
    using scene::Node;
    using Points = std::vector<PiecewiseDrive::ControlPoint>;

    /// Adds the control point that @p text spells ("0.1 0.25"); @p place is "point 3" or "points.dat, line 3".
    void add_point(const Node &node, const std::string &parameter, const std::string &text, const std::string &place, Points &points)
    {
      const std::string  expected = "\"t value\", two finite numbers";
      std::istringstream words(text);
      std::string        t_text, value_text, rest;
      if (!(words >> t_text >> value_text) || (words >> rest))
        node.refuse(parameter, place + ": \"" + scene::trimmed(text) + "\" is not a control point", expected);
      const auto t     = scene::parse_number(t_text);
      const auto value = scene::parse_number(value_text);
      if (!t || !value)
        node.refuse(parameter, place + ": \"" + (t ? value_text : t_text) + "\" is not a finite number", expected);
      points.push_back({*t, *value});
    }

    Points points_of_text(const Node &node)
    {
      Points             points;
      std::istringstream parts(node.text("points"));
      unsigned int       number = 0;
      for (std::string part; std::getline(parts, part, ';');)
        if (!scene::trimmed(part).empty())
          add_point(node, "points", part, "point " + std::to_string(++number), points);
      return points;
    }

    Points points_of_file(const Node &node)
    {
      Points             points;
      std::istringstream file(scene::read_input_text(node.file("file")));
      unsigned int       number = 0;
      for (std::string line; std::getline(file, line);)
        {
          ++number;
          const std::string text = scene::trimmed(line);
          if (!text.empty() && text[0] != '#')
            add_point(node, "file", text, node.file("file").string() + ", line " + std::to_string(number), points);
        }
      return points;
    }
  } // namespace

  std::vector<PiecewiseDrive::ControlPoint> read_control_points(const scene::Node &node)
  {
    if (node.has("points") == node.has("file"))
      node.refuse("points", node.has("points") ? "both \"points\" and \"file\" are given" : "neither \"points\" nor \"file\" is given",
                  "exactly one of them");
    const std::string parameter = node.has("points") ? "points" : "file";
    Points            points    = node.has("points") ? points_of_text(node) : points_of_file(node);
    if (points.empty())
      node.refuse(parameter, "there is no control point", "at least one \"t value\"");
    const double least_gap = 4 * PiecewiseDrive::tolerance(points);
    for (std::size_t i = 1; i < points.size(); ++i)
      if (!(points[i].t - points[i - 1].t > least_gap))
        node.refuse(parameter,
                    "unsorted: time " + scene::format_number(points[i].t) + " of control point " + std::to_string(i + 1) +
                        " follows time " + scene::format_number(points[i - 1].t),
                    "strictly ascending times", "a jump must be written as a short ramp");
    for (auto &point : points)
      point.value *= node.number("scale");
    return points;
  }
} // namespace myolines
