// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle3d/plausibility.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    constexpr double longest = 1, thinnest = 1e-4; // [m]

    /// Factor that takes a value into a range, where a usual one does; else 0.
    double mending_factor(const double value, const double low, const double high, const std::vector<double> &factors)
    {
      for (const double factor : factors)
        if (value * factor >= low && value * factor <= high)
          return factor;
      return 0;
    }

    void judge(const std::string &name, const double value, const std::string &unit, const double low, const double high,
               const std::vector<std::pair<double, std::string>> &meant, std::vector<std::string> &sentences)
    {
      if (value >= low && value <= high)
        return;
      std::ostringstream text;
      const std::string  behind = unit.empty() ? "" : " " + unit;
      text << name << " is " << value << behind << "; usual are " << low << " to " << high << behind;
      for (const auto &[factor, of] : meant)
        if (value * factor >= low && value * factor <= high)
          {
            text << ": " << of << " instead of " << unit << "? That would be " << value * factor;
            break;
          }
      sentences.push_back(text.str());
    }
    /// Of a table of points that is much larger or smaller than the body: nearly all of the body is near to one of its points.
    std::string implausible_table(const Muscle3dParameters &parameters)
    {
      constexpr double much = 50; // centimetres are 100 times as many as metres
      if (!parameters.fields.table)
        return "";
      const auto        &size = parameters.geometry.size;
      const double       body = std::hypot(size[0], size[1], size[2]), extent = parameters.fields.table->extent();
      std::ostringstream text;
      if (extent > much * body || extent < body / much)
        text << "the points in " << parameters.fields.table->file().string() << " extend over " << extent << " m, the body over " << body
             << " m. Is \"table scale\" in system/fields the unit of the table (m, cm, mm, um)?";
      return text.str();
    }

    std::string implausible_angle(const Muscle3dParameters &parameters)
    {
      const double       angle = std::abs(parameters.pennation_angle.value_or(0)), right = std::acos(-1) / 2;
      std::ostringstream text;
      if (angle > 0 && angle <= right)
        text << "the fibres have a pennation of " << angle << " degrees. Were radians meant? That would be " << angle * 90 / right
             << " degrees";
      return text.str();
    }
  } // namespace

  double probable_scale(const Geometry &geometry)
  {
    const auto [least, most] = std::minmax_element(geometry.size.begin(), geometry.size.end());
    if (*most > longest)
      return mending_factor(*most, 0.002, longest, {1e-3, 1e-2, 1e-6});
    return *least < thinnest ? mending_factor(*most, 0.002, longest, {1e3, 1e2, 1e6}) : 1;
  }

  std::string implausible_size(const Geometry &geometry)
  {
    const double most  = *std::max_element(geometry.size.begin(), geometry.size.end()),
                 least = *std::min_element(geometry.size.begin(), geometry.size.end());
    std::ostringstream text;
    if (most > longest)
      {
        text << "the body is " << most << " m long; lengths are in metres";
        if (const double factor = probable_scale(geometry); factor != 0)
          {
            text << ". " << (factor == 1e-3 ? "Millimetres" : factor == 1e-2 ? "Centimetres" : "Micrometres") << " were probably meant: ";
            if (geometry.mesh)
              text << "geometry/scale = " << factor << " times what it is ("
                   << (factor == 1e-3   ? "mm"
                       : factor == 1e-2 ? "cm"
                                        : "um")
                   << " for a mesh that is read as metres now)";
            else
              text << "a length of " << most * factor << " m";
          }
      }
    else if (least < thinnest)
      text << "the body is " << least << " m thin; lengths are in metres"
           << (geometry.mesh ? ". Is geometry/scale applied to a mesh that is in metres already?" : "");
    return text.str();
  }

  std::vector<std::string> implausible_values(const Muscle3dParameters &parameters)
  {
    std::vector<std::string> sentences;
    if (const std::string size = implausible_size(parameters.geometry); !size.empty())
      sentences.push_back(size);
    if (parameters.geometry.mesh)
      sentences.insert(sentences.end(), parameters.geometry.mesh->doubts.begin(), parameters.geometry.mesh->doubts.end());
    if (parameters.geometry.mesh && parameters.geometry.mesh->worst < 0.01)
      {
        std::ostringstream text;
        text << "the mesh has nearly degenerate cells: smallest scaled Jacobian " << parameters.geometry.mesh->worst
             << "; below 0.01 results are doubtful and solves slow";
        sentences.push_back(text.str());
      }
    for (const std::string &sentence : {implausible_table(parameters), implausible_angle(parameters)})
      if (!sentence.empty())
        sentences.push_back(sentence);
    for (const auto &[id, tissue] : parameters.tissues)
      {
        const std::string &name = parameters.tissue_names[id - 1];
        if (id == muscle_id && tissue.fibre.sigma0 != 0)
          judge("the maximum isometric stress", tissue.fibre.sigma0, "Pa", 1e3, 1e7, {{1e3, "kPa"}, {1e6, "MPa"}, {1e4, "N/cm^2"}},
                sentences);
        judge("the density of " + name, tissue.density, "kg/m^3", 500, 2000, {{1e3, "g/cm^3"}, {1e12, "t/mm^3"}, {1e9, "kg/mm^3"}},
              sentences);
        judge("the bulk modulus of " + name, tissue.bulk_modulus, "Pa", 1e4, 1e10, {{1e3, "kPa"}, {1e6, "MPa"}, {1e9, "GPa"}}, sentences);
        if (const double mu = 2 * tissue.base.coefficients()[0]; mu > 0 && !tissue.matrix)
          judge("the bulk modulus over the shear modulus of " + name, tissue.bulk_modulus / mu, "", 2, 1e6, {}, sentences);
      }
    return sentences;
  }
} // namespace myolines
