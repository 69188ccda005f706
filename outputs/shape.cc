// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>

namespace myolines
{
  /// shape.csv: width and thickness of the middle (measure_middle()), length, volume over that at rest.
  SeriesEntry shape_series()
  {
    return switched_series(
        "shape", false, SeriesNeeds::line,
        "shape.csv: width and thickness of the slab, length along the line of action, volume over that at rest.",
        [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
          const auto thickness = thickness_direction(context.system);
          if (!thickness)
            context.series.refuse(
                "shape", "thickness has no direction: the fibres of the slab do not lean from the line of action, or lean to all sides",
                "a \"thickness\" in \"system/line of action\"");
          const State  still = context.system.still_state();
          const double rest  = measure_body(context.system, still, SlabRule::quadrature_points).volume;
          return make_series_file(
              context.folder, {"shape.csv", "Shape of the belly: length, width, thickness, volume"},
              {"Time [s]", "Muscle length [m]", "Width [m]", "Thickness [m]", "Volume ratio"},
              [rest, thickness = *thickness](const Muscle3dSample &sample) {
                const MiddleSize middle = measure_middle(sample.system(), sample.state(), thickness);
                return std::vector<double>{sample.t(), sample.muscle_length(), middle.width, middle.thickness, sample.body().volume / rest};
              });
        });
  }
} // namespace myolines
