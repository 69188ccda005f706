// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>
#include <myolines/observers/stress_columns.h>

namespace myolines
{
  SeriesEntry energies_series()
  {
    return switched_series("energies", true, SeriesNeeds::nothing, "energy_data-3d.csv: work-like densities (6.2.2)-(6.2.11).",
                           [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
                             const StressParts        parts(context.system.parameters());
                             std::vector<std::string> columns{"Time [s]", "Kinetic [J/m^3]"};
                             for (const std::string &part : parts.names("Aponeurosis"))
                               columns.push_back((part == "Total" ? "Internal" : part) + " [J/m^3]");
                             columns.push_back("Volume [m^3]");
                             return make_series_file(context.folder, {"energy_data-3d.csv", "Energy densities by part of the stress"},
                                                     columns, [parts](const Muscle3dSample &sample) {
                                                       const BodyMeasures &body = sample.body();
                                                       std::vector<double> row{sample.t(), body.kinetic / body.volume};
                                                       for (const double density : parts.values(body.work_density))
                                                         row.push_back(density);
                                                       row.push_back(body.volume);
                                                       return row;
                                                     });
                           });
  }
} // namespace myolines
