// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/output/text_file.h>

#include "point_sheets.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>

namespace myolines
{
  namespace
  {
    /// Uniaxial Cauchy stress [Pa] at constant volume, stretched along the fibres or along an axis across them: what the law adds to the
    /// force of a bar whose sides are free on average.
    double uniaxial(const TissuePart &part, const double stretch, const double rate, const int axis, const curves::FibreCurves &curves)
    {
      const double        across = 1 / std::sqrt(stretch);
      Deformation<double> at;
      at.F = at.F_rate = Mat3<double>::zero();
      for (int i = 0; i < 3; ++i)
        {
          at.F(i, i)      = i == axis ? stretch : across;
          at.F_rate(i, i) = i == axis ? stretch * rate : -across * rate / 2;
        }
      at.a0                     = {{1, 0, 0}};
      at.activation             = 0;
      at.curves                 = &curves;
      const Mat3<double> P      = part.law->stress(strain(at));
      double             stress = 0;
      for (int i = 0; i < 3; ++i)
        stress += (i == axis ? 1 : -0.5) * P(i, i) * at.F(i, i);
      if (!std::isfinite(stress))
        throw InputError(InputProblem{"--stretch, --strain-rate",
                                      "the stress of " + part.name + " at stretch " + exact_text(stretch) + " and strain rate " +
                                          exact_text(rate) + " is not finite",
                                      "ranges in which stresses are finite", ""});
      return part.weight * stress;
    }

    void print_laws(const LawSheets &sheets, std::ostream &out)
    {
      out << sheets.name << ", its laws along the fibres\n  stretch [-]";
      for (const TissuePart &part : sheets.tissue.laws)
        out << std::setw(std::max<int>(18, static_cast<int>(part.name.size()) + 8)) << part.name + " [kPa]";
      out << "\n";
      for (int i = -2; i <= 3; ++i)
        {
          out << std::fixed << std::setprecision(1) << std::setw(9) << 1 + 0.1 * i << std::setprecision(3);
          for (const TissuePart &part : sheets.tissue.laws)
            out << std::setw(std::max<int>(18, static_cast<int>(part.name.size()) + 8))
                << 1e-3 * uniaxial(part, 1 + 0.1 * i, 0, 0, sheets.curves);
          out << "\n";
        }
    }
  } // namespace

  std::vector<study::Picture> law_sheets(const LawSheets &sheets, const PointOptions &options, std::ostream &out)
  {
    std::vector<study::Picture> pictures;
    std::vector<std::string>    parts;
    for (const TissuePart &part : sheets.tissue.laws)
      parts.push_back(part.name);
    const auto add = [&](const std::string &name, const std::string &title, const std::string &abscissa, const std::vector<double> &xs,
                         const auto &stress) {
      PointSheet sheet({options.folder, sheets.name + "_" + name, title, abscissa, "stress [Pa]", " [Pa]"}, parts);
      for (const double x : xs)
        {
          std::vector<double> row;
          for (const TissuePart &part : sheets.tissue.laws)
            row.push_back(stress(part, x));
          sheet.row(x, row);
        }
      pictures.push_back(sheet.finish());
    };
    const std::vector<double> stretches = spaced(options.stretch, "--stretch", 0);
    for (const int axis : {0, 1})
      add(axis == 0 ? "laws_along" : "laws_across",
          std::string("Laws of ") + sheets.name + (axis == 0 ? ", along" : ", across") + " the fibres", "stretch [-]", stretches,
          [&](const TissuePart &part, const double x) { return uniaxial(part, x, 0, axis, sheets.curves); });
    if (sheets.tissue.viscous())
      add("laws_strain_rate", "Laws of " + sheets.name + " at stretch 1, along the fibres", "strain rate [1/s]",
          spaced(options.strain_rate, "--strain-rate", -1e9),
          [&](const TissuePart &part, const double x) { return uniaxial(part, 1, x, 0, sheets.curves); });
    print_laws(sheets, out);
    return pictures;
  }
} // namespace myolines
