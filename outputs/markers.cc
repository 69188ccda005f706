// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/measures/marker_probe.h>
#include <myolines/observers/markers.h>
#include <myolines/observers/muscle3d_series.h>

namespace myolines
{
  /// displacements-3d.csv.
  SeriesEntry markers_series()
  {
    return {"markers",
            false,
            SeriesNeeds::nothing,
            add_marker_parameters,
            [](const scene::Node &series) { return !read_markers(series).empty(); },
            [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
              const auto probe =
                  std::make_shared<MarkerProbe>(context.system, read_markers(context.series), markers_origin(context.series));
              std::vector<std::string> columns{"Time [s]"};
              for (const Marker &marker : probe->markers())
                for (const char *axis : {"_x [m]", "_y [m]", "_z [m]"})
                  columns.push_back(marker.name + axis);
              return make_series_file(context.folder, {"displacements-3d.csv", "Displacements of the markers"}, columns,
                                      [probe](const Muscle3dSample &sample) {
                                        std::vector<double> row{sample.t()};
                                        for (const dealii::Tensor<1, 3> &u : probe->displacements(sample.state()))
                                          row.insert(row.end(), {u[0], u[1], u[2]});
                                        return row;
                                      });
            }};
  }
} // namespace myolines
