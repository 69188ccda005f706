// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/measures/fascicles.h>
#include <myolines/observers/muscle3d_series.h>

#include <algorithm>

namespace myolines
{
  /// fascicles.csv: mean, least and greatest length of Fascicles, means of their stretch, velocity and curvature and, where there is a line
  /// of action, of their angle to it.
  SeriesEntry fascicles_series()
  {
    return {
        "fascicles",
        false,
        SeriesNeeds::nothing,
        [](scene::Schema &series) {
          series.integer(
              "fascicles", 0, scene::Range::closed(0, 100000),
              "fascicles.csv: lengths and shapes of at most so many lines along the fibres, through cells of the slab; 0: no such file.");
        },
        [](const scene::Node &series) { return series.integer("fascicles") > 0; },
        [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
          const auto fascicles = std::make_shared<Fascicles>(context.system, context.series.integer("fascicles"));
          if (fascicles->size() == 0)
            throw InputError(InputProblem{"output/series/fascicles", "no line along the fibres ends: there is nothing to measure",
                                          "0, or fibres that run from one end of the muscle to another", ""});
          const bool               line = context.system.line_of_action().line.has_value();
          std::vector<std::string> columns{"Time [s]",     "Mean length [m]",     "Least length [m]",    "Greatest length [m]",
                                           "Mean stretch", "Mean velocity [m/s]", "Mean curvature [1/m]"};
          if (line)
            columns.push_back("Mean angle to the line [deg]");
          return make_series_file(context.folder, {"fascicles.csv", "Fascicles: lengths, stretch, velocity, curvature, angle"}, columns,
                                  [fascicles, line](const Muscle3dSample &sample) {
                                    const std::vector<Fascicles::Shape> shapes = fascicles->shapes(sample.state());
                                    const auto                          n      = static_cast<double>(shapes.size());
                                    std::vector<double> row{sample.t(), 0, shapes.front().length, shapes.front().length, 0, 0, 0};
                                    double              angle = 0;
                                    for (std::size_t i = 0; i < shapes.size(); ++i)
                                      {
                                        row[1] += shapes[i].length / n;
                                        row[2] = std::min(row[2], shapes[i].length);
                                        row[3] = std::max(row[3], shapes[i].length);
                                        row[4] += shapes[i].length / fascicles->rest_lengths()[i] / n;
                                        row[5] += shapes[i].rate / n;
                                        row[6] += shapes[i].curvature / n;
                                        angle += shapes[i].angle / n;
                                      }
                                    if (line)
                                      row.push_back(angle);
                                    return row;
                                  });
        }};
  }
} // namespace myolines
