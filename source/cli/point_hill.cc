// SPDX-License-Identifier: LGPL-2.1-or-later
#include "point_sheets.h"

#include <iomanip>

namespace myolines
{
  namespace
  {
    const std::string ordinate = "force/F0 [-]", unit = " force/F0 [-]";

    /// Thesis Figure 3.4: what the parts add to the force at rest, fully active.
    study::Picture parts_sheet(const HillForce &force, const std::vector<double> &stretches, const std::filesystem::path &folder)
    {
      PointSheet sheet({folder, "muscle_parts", "Force at rest, fully active, by its parts", "stretch [-]", ordinate, unit},
                       {"active", "passive", "base material", "total"});
      for (const double l : stretches)
        {
          const double total = force.isometric(l, 1).value, inactive = force.isometric(l, 0).value,
                       base = force.base.fraction * force.base.force(l).value;
          sheet.row(l, {total - inactive, inactive - base, base, total});
        }
      return sheet.finish();
    }

    /// The force of all activations against stretch at rest, or against the strain rate at stretch 1.
    study::Picture total_sheet(const HillForce &force, const bool of_rate, const std::vector<double> &points,
                               const std::vector<double> &activations, const std::filesystem::path &folder)
    {
      std::vector<std::string> columns;
      for (const double a : activations)
        columns.push_back(label_of_activation(a));
      PointSheet sheet(of_rate ? PointSheet::Names{folder, "muscle_strain_rate", "Force at stretch 1", "strain rate [-]", ordinate, unit}
                               : PointSheet::Names{folder, "muscle_stretch", "Force at rest", "stretch [-]", ordinate, unit},
                       columns);
      for (const double x : points)
        {
          std::vector<double> forces;
          for (const double a : activations)
            forces.push_back(of_rate ? force(1, x * force.maximum_strain_rate, a).force : force.isometric(x, a).value);
          sheet.row(x, forces);
        }
      return sheet.finish();
    }

    /// Where longer is weaker, chains part.
    void print_falling_ranges(const HillForce &force, const std::vector<double> &stretches, std::ostream &out)
    {
      const auto falls = [&](const std::size_t i) { return force.isometric(stretches[i], 1).slope < 0; };
      bool       none  = true;
      for (std::size_t i = 0; i < stretches.size(); ++i)
        if (falls(i) && (i == 0 || !falls(i - 1)))
          {
            std::size_t end = i;
            while (end + 1 < stretches.size() && falls(end + 1))
              ++end;
            out << "The force, fully active at rest, falls at stretches from " << std::setprecision(4) << stretches[i] << " to "
                << stretches[end] << ".\n";
            none = false;
          }
      if (none)
        out << "The force, fully active at rest, falls nowhere.\n";
    }
  } // namespace

  std::vector<study::Picture> hill_sheets(const HillForce &force, const PointOptions &options, std::ostream &out)
  {
    const std::vector<double> stretches = spaced(options.stretch, "--stretch", 0),
                              rates     = spaced(options.strain_rate, "--strain-rate", -1e9);
    print_falling_ranges(force, stretches, out);
    return {parts_sheet(force, stretches, options.folder), total_sheet(force, false, stretches, options.activation, options.folder),
            total_sheet(force, true, rates, options.activation, options.folder)};
  }
} // namespace myolines
