// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>
#include <myolines/output/csv_file.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    std::vector<std::string> balance_columns(const bool springs, const bool laws)
    {
      std::vector<std::string> columns{"Time [s]",           "Kinetic [J]",         "Stored volumetric [J]", "Stored base [J]",
                                       "Stored passive [J]", "Active work [J]",     "Dissipated [J]",        "External work [J]",
                                       "Balance drift [J]",  "Stored tendinous [J]"};
      if (springs)
        columns.push_back("Stored springs [J]");
      if (laws)
        columns.push_back("Stored laws [J]");
      return columns;
    }

    /// energy_balance.csv: energies, works and drift; the balance is followed over every step.
    class EnergyBalanceFile : public SeriesFile
    {
    public:
      EnergyBalanceFile(const OutputFolder &folder, const bool springs, const bool laws)
        : springs_(springs)
        , laws_(laws)
        , csv_(folder, "energy_balance.csv", balance_columns(springs, laws))
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
      const bool    springs_, laws_;
      CsvFile       csv_;
      EnergyBalance balance_;
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
                             return std::make_unique<EnergyBalanceFile>(context.folder, springs, body.any_laws());
                           });
  }
} // namespace myolines
