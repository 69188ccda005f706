// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/measures/momenta.h>
#include <myolines/observers/muscle3d_series.h>

#include <utility>

namespace myolines
{
  SeriesEntry momenta_series()
  {
    return switched_series("momenta", false, SeriesNeeds::velocities,
                           "momenta.csv: centre of mass, momentum, and angular momentum about the centre of mass; dynamic systems only.",
                           [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
                             std::vector<std::string> columns{"Time [s]"};
                             for (const auto &[name, unit] :
                                  {std::pair{"Centre of mass ", " [m]"}, {"Momentum ", " [kg m/s]"}, {"Angular momentum ", " [kg m^2/s]"}})
                               for (const char *axis : {"x", "y", "z"})
                                 columns.push_back(name + std::string(axis) + unit);
                             return make_series_file(context.folder, {"momenta.csv", "Centre of mass, momentum and angular momentum"},
                                                     columns, [](const Muscle3dSample &sample) {
                                                       const Momenta       m = measure_momenta(sample.system(), sample.state());
                                                       std::vector<double> row{sample.t()};
                                                       for (const auto *vector : {&m.centre, &m.momentum, &m.angular_momentum})
                                                         row.insert(row.end(), {(*vector)[0], (*vector)[1], (*vector)[2]});
                                                       return row;
                                                     });
                           });
  }
} // namespace myolines
