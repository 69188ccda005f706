// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/measures/marker_probe.h>
#include <myolines/observers/muscle3d_series.h>
#include <myolines/observers/places.h>

namespace myolines
{
  /// strain.csv: strain and strain rate along the line of action of the parts of the body up to p L, from the displacements and velocities
  /// of points of the line between the centres of the faces at its ends, which are L apart; places p in (0, 1].
  SeriesEntry strain_places_series()
  {
    return {
        "strain places",
        false,
        SeriesNeeds::line,
        [](scene::Schema &series) {
          add_strain_places(series, "points of the line from the centre of the face where the line of action begins to that where it ends");
        },
        [](const scene::Node &series) { return series.has("strain places"); },
        [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
          const std::vector<double>  places = read_strain_places(context.series);
          const Geometry            &body   = context.system.parameters().geometry;
          const LineOfAction        &line   = context.system.line_of_action().line.value();
          const dealii::Point<3>     from   = face_centre(body, line.from);
          const dealii::Tensor<1, 3> span   = face_centre(body, line.to) - from;
          std::vector<Marker>        markers{{"beginning of the line of action", from}};
          for (const double place : places)
            markers.push_back({"place", from + place * span});
          const auto probe = std::make_shared<MarkerProbe>(context.system, markers, "output/series/strain places");
          return make_series_file(context.folder, {"strain.csv", "Strains and strain rates along the line of action"},
                                  strain_columns(places),
                                  [probe, places, length = span * line.direction, along = line.direction](const Muscle3dSample &sample) {
                                    const auto parts = [&](const Vector &x) {
                                      std::vector<double> values;
                                      for (const dealii::Tensor<1, 3> &value : probe->values(x))
                                        values.push_back(value * along);
                                      return values;
                                    };
                                    return strain_row(sample.t(), places, length, parts(sample.state().u), parts(sample.state().v));
                                  });
        }};
  }
} // namespace myolines
