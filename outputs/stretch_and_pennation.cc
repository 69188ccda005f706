// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>

namespace myolines
{
  SeriesEntry stretch_and_pennation_series()
  {
    return switched_series(
        "stretch and pennation", true, SeriesNeeds::line, "mean_stretch_pennation_data-3d.csv: slab averages (6.2.22), (6.2.25).",
        [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
          return make_series_file(
              context.folder, {"mean_stretch_pennation_data-3d.csv", "Stretch and pennation of the fibres, mean over the middle"},
              {"Time [s]", "Mean stretch", "Mean pennation [deg]", "Volume slab [m^3]"}, [](const Muscle3dSample &sample) {
                const BodyMeasures &body = sample.body();
                return std::vector<double>{sample.t(), body.mean_stretch, body.mean_pennation, body.slab_volume};
              });
        });
  }
} // namespace myolines
