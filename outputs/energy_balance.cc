// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>
#include <myolines/output/csv_file.h>

#include <algorithm>
#include <map>

namespace myolines
{
  namespace
  {
    /// The laws that can store energy, with their places in BodyMeasures::stored_by_law.
    std::map<std::size_t, std::string> storing_laws(const Muscle3dParameters &body)
    {
      std::map<std::size_t, std::string> laws;
      const std::vector<LawPart>         parts = body.law_parts();
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].part->law->kind.has_energy)
          laws[i] = parts[i].name;
      return laws;
    }

    std::vector<std::string> balance_columns(const bool springs, const Muscle3dParameters &body)
    {
      std::vector<std::string> columns{"Time [s]",           "Kinetic [J]",         "Stored volumetric [J]", "Stored base [J]",
                                       "Stored passive [J]", "Active work [J]",     "Dissipated [J]",        "External work [J]",
                                       "Balance drift [J]",  "Stored tendinous [J]"};
      if (springs)
        columns.push_back("Stored springs [J]");
      if (body.any_laws())
        columns.push_back("Stored laws [J]");
      for (const auto &[place, name] : storing_laws(body))
        columns.push_back("Stored " + name + " [J]");
      return columns;
    }

    /// energy_balance.csv: energies, works and drift; the balance is followed over every step.
    class EnergyBalanceFile : public SeriesFile
    {
    public:
      EnergyBalanceFile(const OutputFolder &folder, const bool springs, const Muscle3dParameters &body)
        : springs_(springs)
        , laws_(body.any_laws())
        , storing_laws_(storing_laws(body))
        , csv_(folder, {"energy_balance.csv", "Energies, works and the drift of their balance"}, balance_columns(springs, body))
      {
        if (folder.saved != nullptr)
          balance_.load(*folder.saved);
      }

      const EnergyBalance *energy_balance() const override { return &balance_; }

      void row(const Muscle3dSample &sample, std::size_t) override
      {
        balance_.accepted(sample.t(), sample.energetics());
        const BodyMeasures &body = sample.body();
        std::vector<double> row{sample.t(),
                                body.kinetic,
                                body.stored_volumetric,
                                body.stored_base,
                                body.stored_passive,
                                balance_.active_work(),
                                balance_.dissipated(),
                                balance_.external_work(),
                                balance_.report().drift,
                                body.stored_tendinous};
        if (springs_)
          row.push_back(body.stored_springs);
        if (laws_)
          row.push_back(body.stored_laws);
        for (const auto &[place, name] : storing_laws_)
          row.push_back(body.stored_by_law.at(place));
        csv_.row(row);
      }

      void pass(const Muscle3dSample &sample) override
      {
        balance_.started() ? balance_.accepted(sample.t(), sample.energy_rates()) : balance_.accepted(sample.t(), sample.energetics());
      }

      void restarting(const Muscle3dSample &sample) override
      {
        if (!balance_.looked_at(sample.t()))
          balance_.accepted(sample.t(), sample.energetics());
      }

      void restarted(const Muscle3dSample &sample) override { balance_.restarted(sample.t(), sample.energetics()); }

      void save(Archive &archive) const override
      {
        csv_.save(archive);
        balance_.save(archive);
      }

    private:
      const bool                               springs_, laws_;
      const std::map<std::size_t, std::string> storing_laws_;
      CsvFile                                  csv_;
      EnergyBalance                            balance_;
    };
  } // namespace

  SeriesEntry energy_balance_series()
  {
    return switched_series("energy balance", true, SeriesNeeds::velocities,
                           "energy_balance.csv: energies, works and the drift of their balance; dynamic systems only.",
                           [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
                             if (context.folder.rows_are_read())
                               return nullptr; // works are of a run, not of a state
                             const Muscle3dParameters &body    = context.system.parameters();
                             const bool                springs = std::any_of(body.boundary.begin(), body.boundary.end(),
                                                                             [](const auto &condition) { return condition->facts().supports; });
                             return std::make_unique<EnergyBalanceFile>(context.folder, springs, body);
                           });
  }
} // namespace myolines
