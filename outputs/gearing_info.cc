// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>

namespace myolines
{
  SeriesEntry gearing_info_series()
  {
    return switched_series(
        "gearing info", true, SeriesNeeds::velocities_and_line, "gearing_info-3d.csv: velocities behind the gearing; dynamic systems only.",
        [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
          const std::vector<std::string> columns{"Time [s]",
                                                 "Prescribed velocity x [m/s]",
                                                 "Mean muscle velocity x [m/s]",
                                                 "Mean muscle velocity y [m/s]",
                                                 "Mean muscle velocity z [m/s]",
                                                 "Mean muscle velocity norm [m/s]",
                                                 "Mean fibre strain rate (non-dim)",
                                                 "Initial fibre length [m]",
                                                 "Maximum strain rate [1/s]",
                                                 "Mean fibre velocity [m/s]",
                                                 "Volume slab [m^3]"};
          const double                   fibre = context.fibre.length();
          const double                   e0    = context.system.parameters().muscle().fibre.maximum_strain_rate;
          return make_series_file(context.folder, {"gearing_info-3d.csv", "Lengths, velocities and strain rates behind the gearing"},
                                  columns, [fibre, e0](const Muscle3dSample &sample) {
                                    const BodyMeasures &body = sample.body();
                                    const auto         &v    = body.mean_velocity;
                                    return std::vector<double>{
                                        sample.t(),      sample.force_face_speed(), v[0],  v[1], v[2],
                                        v.norm(),        body.mean_strain_rate,     fibre, e0,   fibre * e0 * body.mean_strain_rate,
                                        body.slab_volume};
                                  });
        });
  }
} // namespace myolines
