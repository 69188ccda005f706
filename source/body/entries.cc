// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/body/entries.h>
#include <myolines/materials/tissue.h>
#include <myolines/scene/formula.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace myolines
{
  using scene::Node;
  using scene::Range;
  using scene::Schema;

  const std::array<const char *, 3> axes{{"x", "y", "z"}};

  void add_formulas(Schema &schema, const std::string &prefix, const std::string &what, const std::string &fourth)
  {
    for (const char *axis : axes)
      schema.text(prefix + axis, "0", what + ", " + axis + " component: a formula of x, y, z [m] and " + fourth + ".");
  }

  std::string read_formula(const Node &node, const std::string &parameter, const std::string &fourth)
  {
    const std::string text = node.text(parameter);
    try
      {
        const VectorFormula formula(std::array<std::string, 3>{{text, "0", "0"}}, fourth);
      }
    catch (const std::invalid_argument &error)
      {
        node.refuse(parameter, error.what(), "one expression of x, y, z, " + fourth + " and pi, for example \"1+0.1*sin(2*pi*x)\"");
      }
    return text;
  }

  std::array<std::string, 3> read_formulas(const Node &node, const std::string &prefix, const std::string &fourth)
  {
    std::array<std::string, 3> text;
    for (unsigned int c = 0; c < 3; ++c)
      text[c] = read_formula(node, prefix + axes[c], fourth);
    return text;
  }

  double read_unit(const Node &node, const std::string &parameter)
  {
    static const std::map<std::string, double> metres{{"m", 1}, {"dm", 0.1}, {"cm", 0.01}, {"mm", 1e-3}, {"um", 1e-6}, {"inch", 0.0254}};
    const std::string                          text = scene::trimmed(node.text(parameter));
    if (const auto unit = metres.find(text); unit != metres.end())
      return unit->second;
    std::vector<std::string> names;
    for (const auto &[name, factor] : metres)
      names.push_back(name);
    const auto number = scene::parse_number(text);
    if (!number || !(*number > 0))
      node.refuse(parameter, "\"" + text + "\" is neither a unit nor a factor",
                  "one of " + join(names) + ", or a number > 0: metres per unit of the file", nearest_hint(text, names));
    return *number;
  }

  std::array<double, 3> unit_vector(const std::array<double, 3> &v, const Node &node, const std::string &parameter)
  {
    if (const auto unit = unit_vector(v))
      return *unit;
    node.refuse(parameter, "the direction has no length", "three finite numbers, not all zero");
  }

  std::array<double, 3> read_vector(const Node &node, const std::string &parameter)
  {
    std::istringstream    words(node.text(parameter));
    std::array<double, 3> v{};
    std::string           rest;
    if (!(words >> v[0] >> v[1] >> v[2]) || (words >> rest))
      node.refuse(parameter, "\"" + node.text(parameter) + "\" is not a vector", "three numbers separated by spaces");
    return v;
  }

  std::array<double, 3> read_direction(const Node &node, const std::string &parameter)
  {
    return unit_vector(read_vector(node, parameter), node, parameter);
  }

  void refuse_values_outside(const Node &node, const Drive &drive, const Range &range, const std::string &quantity)
  {
    // Within the first second, at kinks, and at times whose ratio is small from there to 1e5 s; slow oscillations are met too.
    std::vector<double> times;
    for (int i = 0; i <= 1000; ++i)
      times.push_back(1e-3 * i);
    for (int i = 1; i <= 2000; ++i)
      times.push_back(std::pow(10, 2.5e-3 * i));
    std::vector<double> kinks; // of those that repeat for ever not all
    for (double reach = 1; reach <= 1e9 && kinks.size() < 10000; reach *= 10)
      kinks = drive.kinks(-reach, reach);
    times.insert(times.end(), kinks.begin(), kinks.end());
    times.insert(times.end(), {1e9, -1e9});
    double worst = 0, when = 0;
    for (const double t : times)
      if (const double value = drive.value(t, Side::right); !range.contains(value) && !(std::abs(value) <= std::abs(worst)))
        {
          worst = value;
          when  = t;
        }
    if (worst != 0)
      {
        std::ostringstream what;
        what << "the " << quantity << " is " << worst << " at t = " << when << " s";
        node.refuse("type", what.str(), quantity + " " + range.text() + " at all times");
      }
  }
} // namespace myolines
