// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/input_text.h>
#include <myolines/scene/numbers.h>
#include <myolines/system/drive.h>
#include <myolines/system/drive_types.h>
#include <myolines/system/file_drive.h>
#include <myolines/system/steered_drive.h>

#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    using scene::Node;
    using scene::Range;
    using scene::Schema;
    using Points = std::vector<PiecewiseDrive::ControlPoint>;

    Schema points_schema(const std::string &unit, const std::string &doc)
    {
      Schema schema(doc);
      schema.optional_text("points", "Control points \"t value; t value; ...\", times [s] ascending. Either these or a file.")
          .optional_file("file", "Control points, one \"t value\" a line; lines that begin with # are skipped.")
          .number("scale", 1, "-", Range::any(), "Multiplies the values of the control points [" + unit + "].");
      return schema;
    }

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

    Points read_points(const Node &node)
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

    std::unique_ptr<Drive> make_ramp(const Node &node)
    {
      const double start = node.number("start"), duration = node.number("duration");
      const Points points{{start, 0}, {start + duration, node.number("amplitude")}};
      if (!(duration > 4 * PiecewiseDrive::tolerance(points)))
        node.refuse("duration", scene::format_number(duration) + " s vanishes beside the start at " + scene::format_number(start) + " s",
                    "a longer time");
      return std::make_unique<PiecewiseDrive>(PiecewiseDrive::lines(points));
    }

    /// The greatest rate sits in the middle, where the formula puts it, only for c0 <= 2/sqrt(3): rates from sqrt(3) |A| / T on.
    std::unique_ptr<Drive> make_smooth_step(const Node &node)
    {
      const double amplitude = node.number("amplitude"), duration = node.number("duration");
      double       shape = 1;
      if (node.has("maximum rate"))
        {
          const double rate = node.number("maximum rate");
          shape             = 2 * std::abs(amplitude) / (rate * duration);
          if (shape > 2 / std::sqrt(3.))
            node.refuse("maximum rate", scene::format_number(rate) + " is too small for this amplitude and duration",
                        "at least sqrt(3) |amplitude| / duration = " +
                            scene::format_number(std::sqrt(3.) * std::abs(amplitude) / duration));
          if (amplitude == 0)
            shape = 1;
        }
      return std::make_unique<SmoothStep>(amplitude, node.number("start"), duration, shape);
    }
  } // namespace

  scene::Schema drive_schema(const std::string &quantity, const std::string &unit)
  {
    const std::string amplitude = "Amplitude A of the " + quantity + ".";

    Schema constant("The same at all times.");
    constant.number("value", 0, unit, Range::any(), "Value of the " + quantity + ".");

    Schema ramp("From 0 linearly to the amplitude, then constant, thesis (4.7.4); kinks at both ends.");
    ramp.number("amplitude", std::nullopt, unit, Range::any(), amplitude)
        .number("start", 0, "s", Range::any(), "Time at which the ramp begins.")
        .number("duration", std::nullopt, "s", Range::positive(), "Time that the ramp takes.");

    Schema smooth("From 0 infinitely smoothly to the amplitude, thesis (4.7.3).");
    smooth.number("amplitude", std::nullopt, unit, Range::any(), amplitude)
        .number("start", 0, "s", Range::any(), "Time at which the step begins.")
        .number("duration", std::nullopt, "s", Range::positive(), "Time T that the step takes.")
        .optional_number("maximum rate", "1/s", Range::positive(), "Greatest rate, at the middle, >= sqrt(3) |A| / T; absent: 2 |A| / T.");

    Schema sine("offset + A sin(2 pi f t + phase), thesis (4.7.5).");
    sine.number("amplitude", std::nullopt, unit, Range::any(), amplitude)
        .number("frequency", std::nullopt, "Hz", Range::positive(), "Frequency f.")
        .number("phase", 0, "degree", Range::any(), "Phase at time 0.")
        .number("offset", 0, unit, Range::any(), "Mean value.");

    Schema power("A (t - t0)^n from t0 on, 0 before.");
    power.number("amplitude", std::nullopt, unit + "/s^n", Range::any(), "Factor A.")
        .number("start", 0, "s", Range::any(), "Time t0.")
        .integer("exponent", std::nullopt, Range::closed(1, 9), "Exponent n; there is a kink at t0 for n = 1 and 2.");

    Schema schema("The " + quantity + " as a function of time.");
    schema.variant(
        "type", "constant",
        {{"constant", constant},
         {"control points", points_schema(unit, "Straight lines between control points, constant before the first and after the last.")},
         {"file", file_profile_schema(unit)},
         {"spline", points_schema(unit, "The C2 spline through control points with slope zero at both ends, constant outside.")},
         {"ramp", ramp},
         {"smooth step", smooth},
         {"sine", sine},
         {"power", power},
         {"steered", steered_schema(quantity, unit)}},
        "How the " + quantity + " varies.");
    return schema;
  }

  std::unique_ptr<Drive> make_drive(const scene::Node &node) { return make_drive(node, Driven()); }

  std::unique_ptr<Drive> make_drive(const scene::Node &node, const Driven &driven)
  {
    const std::string type = node.text("type");
    if (type == "file")
      return make_file_drive(node, driven);
    if (type == "steered")
      return make_steered_drive(node, driven);
    if (type == "control points")
      return std::make_unique<PiecewiseDrive>(PiecewiseDrive::lines(read_points(node)));
    if (type == "spline")
      return std::make_unique<PiecewiseDrive>(PiecewiseDrive::spline(read_points(node)));
    if (type == "ramp")
      return make_ramp(node);
    if (type == "smooth step")
      return make_smooth_step(node);
    if (type == "power")
      return std::make_unique<Power>(node.number("amplitude"), node.number("start"), node.integer("exponent"));
    if (type == "sine")
      return std::make_unique<Sine>(node.number("amplitude"), node.number("frequency"), node.number("phase") * 3.14159265358979323846 / 180,
                                    node.number("offset"));
    return std::make_unique<PiecewiseDrive>(PiecewiseDrive::constant(node.number("value")));
  }
} // namespace myolines
