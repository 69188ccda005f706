#include "places.h"

#include <myolines/output/csv_file.h>
#include <myolines/output/muscle3d_files.h>

#include <algorithm>
#include <limits>

namespace myolines
{
  std::unique_ptr<SeriesFile> reaction_file(const OutputFolder &folder, const Muscle3dParameters &parameters)
  {
    std::vector<std::string> columns{"Time [s]"};
    for (const BoundaryCondition &condition : parameters.boundary)
      if (condition.reacts())
        for (const char *axis : {" x [N]", " y [N]", " z [N]"})
          columns.push_back(condition.name + axis);
    std::vector<std::string> stopped; // conditions with a stop, whose columns come last
    for (const BoundaryCondition &condition : parameters.boundary)
      if (condition.has_stop())
        {
          stopped.push_back(condition.name);
          columns.push_back(condition.name + " stop [N]");
        }
    return make_series_file(folder, "reaction.csv", columns, [stopped](const Muscle3dSample &sample) {
      std::vector<double> row{sample.t()};
      for (const Reaction &reaction : sample.reactions())
        row.insert(row.end(), {reaction.force[0], reaction.force[1], reaction.force[2]});
      for (const Reaction &reaction : sample.reactions())
        if (std::find(stopped.begin(), stopped.end(), reaction.condition) != stopped.end())
          row.push_back(reaction.stop);
      return row;
    });
  }

  std::unique_ptr<SeriesFile> energy_balance_file(const OutputFolder &folder, const Muscle3dParameters &parameters,
                                                  const EnergyBalance &balance)
  {
    std::vector<std::string> columns{"Time [s]",           "Kinetic [J]",         "Stored volumetric [J]", "Stored base [J]",
                                     "Stored passive [J]", "Active work [J]",     "Dissipated [J]",        "External work [J]",
                                     "Balance drift [J]",  "Stored tendinous [J]"};
    const bool               springs =
        std::any_of(parameters.boundary.begin(), parameters.boundary.end(), [](const BoundaryCondition &c) { return c.is_spring(); });
    if (springs)
      columns.push_back("Stored springs [J]");
    return make_series_file(folder, "energy_balance.csv", columns, [&balance, springs](const Muscle3dSample &sample) {
      const BodyMeasures &body = sample.body();
      std::vector<double> row{sample.t(),
                              body.kinetic,
                              body.stored_volumetric,
                              body.stored_base,
                              body.stored_passive,
                              balance.active_work(),
                              balance.dissipated(),
                              balance.external_work(),
                              balance.report().drift,
                              body.stored_tendinous};
      if (springs)
        row.push_back(body.stored_springs);
      return row;
    });
  }

  std::unique_ptr<SeriesFile> gearing_file(const OutputFolder &folder, const Muscle3dParameters &parameters)
  {
    const double fibre_speed = parameters.fibre_length() * parameters.muscle().fibre.maximum_strain_rate;
    return make_series_file(folder, "gearing.csv",
                            {"Time [s]", "Mean muscle velocity [m/s]", "Mean fibre velocity [m/s]", "Gearing", "Physiological"},
                            [fibre_speed](const Muscle3dSample &sample) {
                              const double muscle = -sample.body().mean_velocity.norm();
                              const double rate = sample.body().mean_strain_rate, fibre = fibre_speed * rate;
                              const double gearing = fibre == 0 ? std::numeric_limits<double>::quiet_NaN() : muscle / fibre;
                              return std::vector<double>{sample.t(), muscle, fibre, gearing, std::abs(rate) <= 1 ? 1. : 0.};
                            });
  }

  std::unique_ptr<SeriesFile> shape_file(const OutputFolder &folder, const Muscle3dSystem &system)
  {
    State still       = system.initial_state(0);
    still.u           = 0;
    const double rest = measure_body(system, still, SlabRule::quadrature_points).volume;
    return make_series_file(
        folder, "shape.csv", {"Time [s]", "Muscle length [m]", "Width [m]", "Thickness [m]", "Volume ratio"},
        [rest](const Muscle3dSample &sample) {
          const MiddleSize middle = measure_middle(sample.system(), sample.state());
          return std::vector<double>{sample.t(), sample.muscle_length(), middle.width, middle.thickness, sample.body().volume / rest};
        });
  }

  std::unique_ptr<SeriesFile> strain_file(const OutputFolder &folder, const Muscle3dSystem &system, const std::vector<double> &places)
  {
    const auto         &size = system.parameters().geometry.size;
    std::vector<Marker> markers{{"fixed end", dealii::Point<3>(0, size[1] / 2, size[2] / 2)}};
    for (const double place : places)
      markers.push_back({"place", dealii::Point<3>(place * size[0], size[1] / 2, size[2] / 2)});
    const auto probe = std::make_shared<MarkerProbe>(system, markers, "output/series/strain places");
    return make_series_file(folder, "strain.csv", strain_columns(places), [probe, places, length = size[0]](const Muscle3dSample &sample) {
      const auto along_x = [&probe](const Vector &x) {
        std::vector<double> values;
        for (const dealii::Tensor<1, 3> &value : probe->values(x))
          values.push_back(value[0]);
        return values;
      };
      return strain_row(sample.t(), places, length, along_x(sample.state().u), along_x(sample.state().v));
    });
  }
} // namespace myolines
