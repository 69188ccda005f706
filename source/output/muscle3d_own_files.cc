#include <myolines/output/csv_file.h>
#include <myolines/output/muscle3d_files.h>

namespace myolines
{
  namespace
  {
    double external_power(const Muscle3dSample &sample)
    {
      double power = sample.body().body_force_power + sample.body().traction_power;
      for (const Reaction &reaction : sample.reactions())
        power += reaction.power;
      return power;
    }

    class EnergyBalance : public SeriesFile
    {
    public:
      explicit EnergyBalance(const std::filesystem::path &file)
        : csv_(file, {"Time [s]", "Kinetic [J]", "Stored volumetric [J]", "Stored base [J]", "Stored passive [J]", "Active work [J]",
                      "Dissipated [J]", "External work [J]", "Balance drift [J]"})
      {}

      void advance(const Muscle3dSample &sample) override
      {
        const BodyMeasures &body = sample.body();
        const Powers        now{sample.t(), body.active_power, body.dissipation, external_power(sample)};
        if (before_)
          {
            const double half = (now.t - before_->t) / 2;
            active_work_ += half * (before_->active + now.active);
            dissipated_ += half * (before_->dissipation + now.dissipation);
            external_work_ += half * (before_->external + now.external);
          }
        else
          energy_at_start_ = energy(body);
        before_ = now;
      }

      void row(const Muscle3dSample &sample, std::size_t) override
      {
        const BodyMeasures &body = sample.body();
        csv_.row(std::vector<double>{sample.t(), body.kinetic, body.stored_volumetric, body.stored_base, body.stored_passive, active_work_,
                                     dissipated_, external_work_,
                                     energy(body) - energy_at_start_ - active_work_ + dissipated_ - external_work_});
      }

    private:
      struct Powers
      {
        double t;
        double active;
        double dissipation;
        double external;
      };

      static double energy(const BodyMeasures &body)
      {
        return body.kinetic + body.stored_volumetric + body.stored_base + body.stored_passive;
      }

      CsvFile               csv_;
      std::optional<Powers> before_;
      double                energy_at_start_ = 0;
      double                active_work_     = 0;
      double                dissipated_      = 0;
      double                external_work_   = 0;
    };
  } // namespace

  std::unique_ptr<SeriesFile> reaction_file(const std::filesystem::path &folder, const Muscle3dParameters &parameters)
  {
    std::vector<std::string> columns{"Time [s]"};
    for (const BoundaryCondition &condition : parameters.boundary)
      if (condition.type != BoundaryCondition::Type::traction)
        for (const char *axis : {" x [N]", " y [N]", " z [N]"})
          columns.push_back(condition.name + axis);
    return make_series_file(folder / "reaction.csv", columns, [](const Muscle3dSample &sample) {
      std::vector<double> row{sample.t()};
      for (const Reaction &reaction : sample.reactions())
        row.insert(row.end(), {reaction.force[0], reaction.force[1], reaction.force[2]});
      return row;
    });
  }

  std::unique_ptr<SeriesFile> energy_balance_file(const std::filesystem::path &folder)
  {
    return std::make_unique<EnergyBalance>(folder / "energy_balance.csv");
  }

  std::unique_ptr<SeriesFile> gearing_file(const std::filesystem::path &folder, const Muscle3dParameters &parameters)
  {
    const double fibre_speed = longest_fibre(parameters) * parameters.tissue.fibre.maximum_strain_rate;
    return make_series_file(folder / "gearing.csv", {"Time [s]", "Mean muscle velocity [m/s]", "Mean fibre velocity [m/s]", "Gearing"},
                            [fibre_speed](const Muscle3dSample &sample) {
                              const double muscle = -sample.body().mean_velocity.norm();
                              const double fibre  = fibre_speed * sample.body().mean_strain_rate;
                              return std::vector<double>{sample.t(), muscle, fibre, muscle / fibre};
                            });
  }
} // namespace myolines
