// SPDX-License-Identifier: LGPL-2.1-or-later
#include "places.h"

#include <myolines/muscle3d/fascicles.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/muscle3d_files.h>

#include <algorithm>
#include <limits>

namespace myolines
{
  std::unique_ptr<SeriesFile> reaction_file(const OutputFolder &folder, const Muscle3dSystem &system)
  {
    const std::vector<BoundaryCondition> &boundary = system.parameters().boundary;
    std::vector<std::string>              columns{"Time [s]"};
    for (const BoundaryCondition &condition : boundary)
      if (condition.reacts())
        for (const char *axis : {" x [N]", " y [N]", " z [N]"})
          columns.push_back(condition.name + axis);
    std::vector<std::string> stopped; // conditions with a stop, whose columns come last
    for (const BoundaryCondition &condition : boundary)
      if (condition.has_stop())
        {
          stopped.push_back(condition.name);
          columns.push_back(condition.name + " stop [N]");
        }
    std::optional<dealii::Tensor<1, 3>> along;
    if (const auto &line = system.line_of_action().line)
      along = line->direction;
    for (const BoundaryCondition &condition : boundary)
      if (condition.reacts() && along)
        columns.push_back(condition.name + " along the line [N]");
    return make_series_file(folder, "reaction.csv", columns, [stopped, along](const Muscle3dSample &sample) {
      std::vector<double> row{sample.t()};
      for (const Reaction &reaction : sample.reactions())
        row.insert(row.end(), {reaction.force[0], reaction.force[1], reaction.force[2]});
      for (const Reaction &reaction : sample.reactions())
        if (std::find(stopped.begin(), stopped.end(), reaction.condition) != stopped.end())
          row.push_back(reaction.stop);
      if (along)
        for (const Reaction &reaction : sample.reactions())
          row.push_back(reaction.force * *along);
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
    const bool laws = parameters.any_laws();
    if (laws)
      columns.push_back("Stored laws [J]");
    return make_series_file(folder, "energy_balance.csv", columns, [&balance, springs, laws](const Muscle3dSample &sample) {
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
      if (laws)
        row.push_back(body.stored_laws);
      return row;
    });
  }

  std::unique_ptr<SeriesFile> gearing_file(const OutputFolder &folder, const Muscle3dSystem &system)
  {
    const double fibre_speed = reference_fibre_length(system) * system.parameters().muscle().fibre.maximum_strain_rate;
    return make_series_file(folder, "gearing.csv",
                            {"Time [s]", "Mean muscle velocity [m/s]", "Mean fibre velocity [m/s]", "Gearing", "Physiological"},
                            [fibre_speed](const Muscle3dSample &sample) {
                              const double muscle = -sample.body().mean_velocity.norm();
                              const double rate = sample.body().mean_strain_rate, fibre = fibre_speed * rate;
                              const double gearing = fibre == 0 ? std::numeric_limits<double>::quiet_NaN() : muscle / fibre;
                              return std::vector<double>{sample.t(), muscle, fibre, gearing, std::abs(rate) <= 1 ? 1. : 0.};
                            });
  }

  std::unique_ptr<SeriesFile> shape_file(const OutputFolder &folder, const Muscle3dSystem &system, const dealii::Tensor<1, 3> &thickness)
  {
    const State  still = system.still_state();
    const double rest  = measure_body(system, still, SlabRule::quadrature_points).volume;
    return make_series_file(
        folder, "shape.csv", {"Time [s]", "Muscle length [m]", "Width [m]", "Thickness [m]", "Volume ratio"},
        [rest, thickness](const Muscle3dSample &sample) {
          const MiddleSize middle = measure_middle(sample.system(), sample.state(), thickness);
          return std::vector<double>{sample.t(), sample.muscle_length(), middle.width, middle.thickness, sample.body().volume / rest};
        });
  }

  std::unique_ptr<SeriesFile> momenta_file(const OutputFolder &folder)
  {
    std::vector<std::string> columns{"Time [s]"};
    for (const auto &[name, unit] :
         {std::pair{"Centre of mass ", " [m]"}, {"Momentum ", " [kg m/s]"}, {"Angular momentum ", " [kg m^2/s]"}})
      for (const char *axis : {"x", "y", "z"})
        columns.push_back(name + std::string(axis) + unit);
    return make_series_file(folder, "momenta.csv", columns, [](const Muscle3dSample &sample) {
      const Momenta       m = measure_momenta(sample.system(), sample.state());
      std::vector<double> row{sample.t()};
      for (const auto *vector : {&m.centre, &m.momentum, &m.angular_momentum})
        row.insert(row.end(), {(*vector)[0], (*vector)[1], (*vector)[2]});
      return row;
    });
  }

  std::unique_ptr<SeriesFile> fascicles_file(const OutputFolder &folder, const Muscle3dSystem &system, const unsigned int number)
  {
    const auto fascicles = std::make_shared<Fascicles>(system, number);
    if (fascicles->size() == 0)
      throw InputError(InputProblem{"output/series/fascicles", "no line along the fibres ends: there is nothing to measure",
                                    "0, or fibres that run from one end of the muscle to another", ""});
    const bool               line = system.line_of_action().line.has_value();
    std::vector<std::string> columns{"Time [s]",     "Mean length [m]",     "Least length [m]",    "Greatest length [m]",
                                     "Mean stretch", "Mean velocity [m/s]", "Mean curvature [1/m]"};
    if (line)
      columns.push_back("Mean angle to the line [deg]");
    return make_series_file(folder, "fascicles.csv", columns, [fascicles, line](const Muscle3dSample &sample) {
      const std::vector<Fascicles::Shape> shapes = fascicles->shapes(sample.state());
      const auto                          n      = static_cast<double>(shapes.size());
      std::vector<double>                 row{sample.t(), 0, shapes.front().length, shapes.front().length, 0, 0, 0};
      double                              angle = 0;
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
  }

  std::unique_ptr<SeriesFile> strain_file(const OutputFolder &folder, const Muscle3dSystem &system, const std::vector<double> &places)
  {
    const Geometry            &body = system.parameters().geometry;
    const LineOfAction        &line = system.line_of_action().line.value();
    const dealii::Point<3>     from = face_centre(body, line.from);
    const dealii::Tensor<1, 3> span = face_centre(body, line.to) - from;
    std::vector<Marker>        markers{{"beginning of the line of action", from}};
    for (const double place : places)
      markers.push_back({"place", from + place * span});
    const auto probe = std::make_shared<MarkerProbe>(system, markers, "output/series/strain places");
    return make_series_file(folder, "strain.csv", strain_columns(places),
                            [probe, places, length = span * line.direction, along = line.direction](const Muscle3dSample &sample) {
                              const auto parts = [&](const Vector &x) {
                                std::vector<double> values;
                                for (const dealii::Tensor<1, 3> &value : probe->values(x))
                                  values.push_back(value * along);
                                return values;
                              };
                              return strain_row(sample.t(), places, length, parts(sample.state().u), parts(sample.state().v));
                            });
  }
} // namespace myolines
