// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/muscle1d/equilibria.h>
#include <myolines/observers/outputs.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/dense_output.h>

#include <algorithm>
#include <limits>

namespace myolines
{
  namespace
  {
    /// A table of what @p values makes of the state at the multiples of an interval.
    class Table : public DenseOutput
    {
    public:
      using Values = std::function<std::vector<double>(const State &)>;

      Table(const double interval, const TableName &name, std::vector<std::string> columns, Values values, const OutputFolder &folder)
        : DenseOutput(multiples_of(interval), "end of " + name.file, folder, true)
        , values_(std::move(values))
        , csv_(folder, name, with_time(std::move(columns)))
      {}

      void save(Archive &archive) const override
      {
        DenseOutput::save(archive);
        csv_.save(archive);
      }

    private:
      static std::vector<std::string> with_time(std::vector<std::string> columns)
      {
        columns.insert(columns.begin(), "Time [s]");
        return columns;
      }

      void write(const double t, const State &state) override
      {
        std::vector<double> row = values_(state);
        row.insert(row.begin(), t);
        csv_.row(row);
      }

      const Values values_;
      CsvFile      csv_;
    };

    std::vector<double> muscle_and_tendon(const Muscle1dSystem &system, const State &state)
    {
      const double tendon = system.tendon_stretch(state.t, state.u);
      return {system.parameters().excitation->value(state.t),
              system.activation(state.t, state.u),
              system.muscle_stretch(state.u),
              system.muscle_strain_rate(state.v),
              tendon - 1,
              hill::tendon(tendon).value};
    }

    std::unique_ptr<Observer> stretches(const scene::Node &node, const Muscle1dSystem &system, const OutputFolder &folder)
    {
      std::vector<std::string> columns;
      for (unsigned int i = 1; i <= system.parameters().n_elements; ++i)
        columns.push_back("stretch " + std::to_string(i));
      return std::make_unique<Table>(
          node.number("interval"), TableName("stretches.csv", "Stretches along the muscle"), columns,
          [&system](const State &state) { return system.element_stretches(state.u); }, folder);
    }

    /// All equilibria of a chain, at the start of a run.
    class Equilibria : public Observer
    {
    public:
      Equilibria(const Muscle1dSystem &system, const OutputFolder &folder)
        : system_(system)
        , csv_(folder, "equilibria.csv",
               {"branch 1 elements", "branch 2 elements", "branch 3 elements", "branch 1 stretch", "branch 2 stretch", "branch 3 stretch",
                "force/F0", "unstable directions"})
      {}

      void begin(const State &state) override
      {
        constexpr std::size_t     branches = 3; // the force rises, falls and rises, or only rises
        const Muscle1dParameters &p        = system_.parameters();
        for (const ChainEquilibrium &e : chain_equilibria(p.force, p.activation->value(state.t), p.n_elements, p.initial_stretch))
          {
            std::vector<double> row(2 * branches + 2, std::numeric_limits<double>::quiet_NaN());
            std::fill_n(row.begin(), branches, 0.);
            if (e.elements.size() > branches)
              throw SolveError("The isometric force has more than three branches, for which equilibria.csv has no columns.");
            std::copy(e.elements.begin(), e.elements.end(), row.begin());
            std::copy(e.stretches.begin(), e.stretches.end(), row.begin() + branches);
            row[2 * branches]     = e.force;
            row[2 * branches + 1] = e.unstable_directions;
            csv_.row(row);
          }
      }

      void save(Archive &archive) const override { csv_.save(archive); }

    private:
      const Muscle1dSystem &system_;
      CsvFile               csv_;
    };

    scene::Schema stretches_schema(const std::optional<double> interval)
    {
      scene::Schema schema("At equal intervals, interpolated within steps: stretches.csv, the mean stretch of every element.");
      schema.number("interval", interval, "s", scene::Range::positive(), "Rows are at its multiples, whatever the steps are.");
      return schema;
    }
  } // namespace

  scene::Schema muscle_tendon_output_schema()
  {
    scene::Schema series(
        "At equal intervals, interpolated within steps: muscle_tendon.csv, excitation, activation, stretch and strain rate of the "
        "muscle, strain of the tendon and its force over F_0.");
    series.number("interval", 0.02, "s", scene::Range::positive(), "Rows are at its multiples, whatever the steps are.");
    return scene::Schema("What to write.").section("series", series).optional_section("stretches", stretches_schema(std::nullopt));
  }

  scene::Schema isometric_chain_output_schema()
  {
    return scene::Schema("What to write.")
        .section("stretches", stretches_schema(0.25))
        .optional_section(
            "equilibria",
            scene::Schema("At the start: equilibria.csv, all equilibria of the chain with the numbers of elements on the branches of its "
                          "force (rising, falling, rising), and in how many directions each is left."));
  }

  std::vector<std::unique_ptr<Observer>> make_outputs(const scene::Node &output, const Muscle1dSystem &system, const OutputFolder &folder,
                                                      WorkLedger &)
  {
    std::vector<std::unique_ptr<Observer>> observers;
    if (system.parameters().tendon)
      observers.push_back(std::make_unique<Table>(
          output.section("series").number("interval"), TableName("muscle_tendon.csv", "Muscle and tendon: lengths, velocities, forces"),
          std::vector<std::string>{"excitation", "activation", "muscle stretch", "muscle strain rate", "tendon strain", "tendon force/F0"},
          [&system](const State &state) { return muscle_and_tendon(system, state); }, folder));
    if (output.has("stretches"))
      observers.push_back(stretches(output.section("stretches"), system, folder));
    if (!system.parameters().tendon && output.has("equilibria"))
      observers.push_back(std::make_unique<Equilibria>(system, folder));
    return observers;
  }
} // namespace myolines
