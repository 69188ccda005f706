// SPDX-License-Identifier: LGPL-2.1-or-later
#include "axis.h"

#include <myolines/scene/numbers.h>

#include <cmath>
#include <cstdio>

namespace myolines::study
{
  namespace
  {
    using scene::Node;
    using scene::Range;
    using scene::Schema;

    Schema range_schema(const std::string &doc, const Range range)
    {
      Schema schema(doc);
      schema.text("parameter", std::nullopt, "Path of the parameter in the scene, \"time/step\".")
          .number("first", std::nullopt, "", range, "First value.")
          .number("last", std::nullopt, "", range, "Last value.")
          .integer("number", std::nullopt, Range::closed(2, 1e6), "How many values, both ends included.");
      return schema;
    }

    /// Six digits: enough to tell points apart and to read.
    std::string short_text(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.6g", value);
      return text;
    }

    AxisPoint point(const std::string &parameter, const double value)
    {
      return {short_text(value), {parameter + "=" + scene::format_number(value)}, value};
    }

    std::vector<AxisPoint> listed(const Node &node)
    {
      std::vector<AxisPoint> points;
      for (const std::string &text : split(node.text("values")))
        points.push_back({text, {node.text("parameter") + "=" + text}, scene::parse_number(text)});
      if (points.empty())
        node.refuse("values", "there is no value", "values separated by |, \"0.1 | 0.05\"");
      return points;
    }

    std::vector<AxisPoint> ranged(const Node &node)
    {
      const double first = node.number("first"), last = node.number("last");
      const int    n           = node.integer("number");
      const bool   logarithmic = node.text("type") == "log range";

      std::vector<AxisPoint> points;
      for (int i = 0; i < n; ++i)
        {
          const double s = static_cast<double>(i) / (n - 1);
          const double x = logarithmic ? first * std::pow(last / first, s) : first + s * (last - first);
          points.push_back(point(node.text("parameter"), i == 0 ? first : i == n - 1 ? last : x)); // the ends without rounding
        }
      return points;
    }

    std::vector<AxisPoint> grouped(const Node &node)
    {
      std::vector<AxisPoint> points;
      for (const Node &group : node.named())
        points.push_back({group.name(), split(group.text("settings")), scene::parse_number(group.name())});
      if (points.empty())
        node.refuse("", "there is no group", "lists with names of your choice, each with a parameter \"settings\"");
      return points;
    }
  } // namespace

  Schema axis_schema()
  {
    Schema list("Values one by one.");
    list.text("parameter", std::nullopt, "Path of the parameter in the scene, \"integrator/type\".")
        .text("values", std::nullopt, "Its values, separated by |, for example \"0.2 | 0.1 | 0.05\".");
    Schema group("One point of the axis; its name is the label.");
    group.text("settings", std::nullopt, "Parameters that it sets, \"time/step=0.01 | time/end=1\".");
    Schema groups("Points that set several parameters at once, a list for each.");
    groups.named_sections(group);

    Schema axis("One axis.");
    axis.variant("type", "list",
                 {{"list", list},
                  {"range", range_schema("Values at equal distances.", Range::any())},
                  {"log range", range_schema("Values at equal ratios.", Range::positive())},
                  {"groups", groups}},
                 "How the points are given.")
        .text("unit", "", "Unit of the values, for pictures, for example \"s\".")
        .optional_text("zipped with",
                       "An axis above of as many points: they go along together instead of being crossed, for example \"method\".");
    return axis;
  }

  double number_of_points(const Node &node)
  {
    const std::string type = node.text("type");
    return type == "list"     ? static_cast<double>(split(node.text("values")).size())
           : type == "groups" ? static_cast<double>(node.named().size())
                              : node.integer("number");
  }

  Axis read_axis(const Node &node)
  {
    const std::string type = node.text("type");
    Axis              axis;
    axis.name        = node.name();
    axis.unit        = node.text("unit");
    axis.zipped_with = node.has("zipped with") ? node.text("zipped with") : "";
    axis.points      = type == "list" ? listed(node) : type == "groups" ? grouped(node) : ranged(node);
    return axis;
  }
} // namespace myolines::study
