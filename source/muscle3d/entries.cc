#include <myolines/muscle3d/entries.h>
#include <myolines/muscle3d/formula.h>

#include <cmath>
#include <sstream>

namespace myolines
{
  using scene::Node;
  using scene::Range;
  using scene::Schema;

  const std::array<const char *, 3> axes{{"x", "y", "z"}};

  void add_formulas(Schema &schema, const std::string &prefix, const std::string &what)
  {
    for (const char *axis : axes)
      schema.text(prefix + axis, "0", what + ", " + axis + " component: a formula of x, y, z [m] and t [s].");
  }

  std::array<std::string, 3> read_formulas(const Node &node, const std::string &prefix)
  {
    std::array<std::string, 3> text;
    for (unsigned int c = 0; c < 3; ++c)
      try
        {
          text[c] = node.text(prefix + axes[c]);
          const VectorFormula formula(std::array<std::string, 3>{{text[c], "0", "0"}});
        }
      catch (const std::invalid_argument &error)
        {
          node.refuse(prefix + axes[c], error.what(), "one expression of x, y, z, t and pi, e.g. \"0.01*x*sin(2*pi*t)\"");
        }
    return text;
  }

  std::array<double, 3> unit_vector(const std::array<double, 3> &v, const Node &node, const std::string &parameter)
  {
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(length > 0) || !std::isfinite(length))
      node.refuse(parameter, "the direction has length " + std::to_string(length), "three finite numbers, not all zero");
    return {{v[0] / length, v[1] / length, v[2] / length}};
  }

  std::array<double, 3> read_direction(const Node &node, const std::string &parameter)
  {
    std::istringstream    words(node.text(parameter));
    std::array<double, 3> v{};
    std::string           rest;
    if (!(words >> v[0] >> v[1] >> v[2]) || (words >> rest))
      node.refuse(parameter, "\"" + node.text(parameter) + "\" is not a vector", "three numbers separated by spaces");
    return unit_vector(v, node, parameter);
  }

  void refuse_values_outside(const Node &node, const Drive &drive, const Range &range, const std::string &quantity)
  {
    std::vector<double> times = drive.kinks(-1e9, 1e9);
    times.insert(times.end(), {-1e9, 1e9});
    for (int i = 0; i <= 1000; ++i)
      times.push_back(1e-3 * i);
    for (const double t : times)
      if (const double value = drive.value(t, Side::right); !range.contains(value))
        node.refuse("type", "the " + quantity + " is " + std::to_string(value) + " at t = " + std::to_string(t) + " s",
                    quantity + " " + range.text());
  }
} // namespace myolines
