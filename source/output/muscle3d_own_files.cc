#include "places.h"

#include <myolines/muscle3d/fascicles.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/muscle3d_files.h>

#include <algorithm>
#include <limits>

namespace myolines
{
  namespace
  {
    class EnergyBalance : public SeriesFile
    {
    public:
      /// @p springs: there are springs at faces, with a column of their own.
      EnergyBalance(const OutputFolder &folder, const bool springs)
        : springs_(springs)
        , csv_(folder, "energy_balance.csv", columns(springs))
      {
        if (folder.saved != nullptr && folder.saved->has_numbers(memory))
          recall(folder.saved->numbers(memory));
      }

      void row(const Muscle3dSample &sample, std::size_t) override
      {
        const BodyMeasures &body = sample.body();
        if (!before_)
          energy_at_start_ = energy(body);
        accumulate(sample);
        std::vector<double> row{
            sample.t(),           body.kinetic,        body.stored_volumetric,
            body.stored_base,     body.stored_passive, active_work_,
            dissipated_,          external_work_,      energy(body) - energy_at_start_ - active_work_ + dissipated_ - external_work_,
            body.stored_tendinous};
        if (springs_)
          row.push_back(body.stored_springs);
        csv_.row(row);
      }

      void pass(const Muscle3dSample &sample) override
      {
        if (!before_)
          energy_at_start_ = energy(sample.body());
        accumulate(sample);
      }

      void save(Archive &archive) const override
      {
        csv_.save(archive);
        if (before_)
          archive.put_numbers(memory, {energy_at_start_, active_work_, dissipated_, external_work_, before_->t, before_->active,
                                       before_->dissipation, before_->external});
      }

    private:
      static std::vector<std::string> columns(const bool springs)
      {
        std::vector<std::string> names{"Time [s]",           "Kinetic [J]",         "Stored volumetric [J]", "Stored base [J]",
                                       "Stored passive [J]", "Active work [J]",     "Dissipated [J]",        "External work [J]",
                                       "Balance drift [J]",  "Stored tendinous [J]"};
        if (springs)
          names.push_back("Stored springs [J]");
        return names;
      }

      /// What the integrals need of an instant.
      struct Rates
      {
        double t;
        double active;
        double dissipation;
        double external;
      };

      static double energy(const BodyMeasures &body)
      {
        return body.kinetic + body.stored_volumetric + body.stored_base + body.stored_passive + body.stored_tendinous + body.stored_springs;
      }

      static Rates rates(const Muscle3dSample &sample)
      {
        const Powers powers = sample.powers();
        Rates        rates{sample.t(), powers.active_power, powers.dissipation, powers.body_force_power + powers.traction_power};
        for (const Reaction &reaction : sample.reactions())
          rates.external += reaction.power;
        return rates;
      }

      void accumulate(const Muscle3dSample &sample)
      {
        const Rates now = rates(sample);
        if (before_)
          {
            const double half = (now.t - before_->t) / 2;
            active_work_ += half * (before_->active + now.active);
            dissipated_ += half * (before_->dissipation + now.dissipation);
            external_work_ += half * (before_->external + now.external);
          }
        before_ = now;
      }

      void recall(const std::vector<double> &saved)
      {
        energy_at_start_ = saved.at(0);
        active_work_     = saved.at(1);
        dissipated_      = saved.at(2);
        external_work_   = saved.at(3);
        before_          = Rates{saved.at(4), saved.at(5), saved.at(6), saved.at(7)};
      }

      static constexpr const char *memory = "energy balance: energy at start, works, last rates";

      const bool           springs_;
      CsvFile              csv_;
      std::optional<Rates> before_;
      double               energy_at_start_ = 0;
      double               active_work_     = 0;
      double               dissipated_      = 0;
      double               external_work_   = 0;
    };
  } // namespace

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

  std::unique_ptr<SeriesFile> energy_balance_file(const OutputFolder &folder, const Muscle3dParameters &parameters)
  {
    return std::make_unique<EnergyBalance>(folder, std::any_of(parameters.boundary.begin(), parameters.boundary.end(),
                                                               [](const BoundaryCondition &c) { return c.is_spring(); }));
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
    State still       = system.initial_state(0);
    still.u           = 0;
    const double rest = measure_body(system, still, SlabRule::quadrature_points).volume;
    return make_series_file(
        folder, "shape.csv", {"Time [s]", "Muscle length [m]", "Width [m]", "Thickness [m]", "Volume ratio"},
        [rest, thickness](const Muscle3dSample &sample) {
          const MiddleSize middle = measure_middle(sample.system(), sample.state(), thickness);
          return std::vector<double>{sample.t(), sample.muscle_length(), middle.width, middle.thickness, sample.body().volume / rest};
        });
  }

  std::unique_ptr<SeriesFile> fascicles_file(const OutputFolder &folder, const Muscle3dSystem &system, const unsigned int number)
  {
    const auto fascicles = std::make_shared<Fascicles>(system, number);
    if (fascicles->size() == 0)
      throw InputError(InputProblem{"output/series/fascicles", "no line along the fibres ends: there is nothing to measure",
                                    "0, or fibres that run from one end of the muscle to another", ""});
    const bool               line = system.line_of_action().line.has_value();
    std::vector<std::string> columns{"Time [s]",           "Mean length [m]",     "Least length [m]",    "Greatest length [m]",
                                     "Mean stretch",       "Mean velocity [m/s]", "Mean curvature [1/m]"};
    if (line)
      columns.push_back("Mean angle to the line [deg]");
    return make_series_file(folder, "fascicles.csv", columns, [fascicles, line](const Muscle3dSample &sample) {
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
  }

  std::unique_ptr<SeriesFile> strain_file(const OutputFolder &folder, const Muscle3dSystem &system, const std::vector<double> &places)
  {
    const Geometry            &body  = system.parameters().geometry;
    const LineOfAction        &line  = system.line_of_action().line.value();
    const dealii::Point<3>     from  = face_centre(body, line.from);
    const dealii::Tensor<1, 3> span  = face_centre(body, line.to) - from;
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
