// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/outputs.h>
#include <myolines/observers/places.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/dense_output.h>
#include <myolines/output/energy_watch.h>
#include <myolines/output/periodic_output.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace myolines
{
  namespace
  {
    std::vector<std::string> trace_columns(const std::vector<double> &places)
    {
      std::vector<std::string> names;
      for (const char *quantity : {"u", "v"})
        for (const double place : places)
          names.push_back(std::string(quantity) + "(" + scene::format_number(place) + " L) [" + (quantity[0] == 'u' ? "m]" : "m/s]"));
      return names;
    }

    std::vector<std::string> with_time(std::vector<std::string> names)
    {
      names.insert(names.begin(), "Time [s]");
      return names;
    }

    std::vector<double> trace(const Rod1dSystem &system, const std::vector<double> &places, const State &state)
    {
      std::vector<double> values;
      for (const Vector *x : {&state.u, &state.v})
        for (const double place : places)
          values.push_back(system.value(*x, place * system.parameters().length));
      return values;
    }

    /// trace.csv and reaction.csv; strain.csv and energy.csv if asked for.
    class RodSeries : public PeriodicOutput
    {
    public:
      RodSeries(const scene::Node &series, const Rod1dSystem &system, const std::vector<double> &places, const OutputFolder &folder)
        : PeriodicOutput(series.integer("every"))
        , system_(system)
        , places_(places)
        , strain_places_(read_strain_places(series))
        , trace_(folder, {"trace.csv", "Displacements and velocities at places of the rod"}, with_time(trace_columns(places)))
        , reaction_(folder, {"reaction.csv", "Forces of the supports"}, {"Time [s]", "moving end x [N]", "fixed end x [N]"})
      {
        if (!strain_places_.empty())
          strain_.emplace(folder, TableName("strain.csv", "Strains and strain rates of the rod"), strain_columns(strain_places_));
        if (series.boolean("energy"))
          energy_.emplace(folder, TableName("energy.csv", "Energies of the rod"),
                          std::vector<std::string>{"Time [s]", "Kinetic [J]", "Stored [J]", "Total [J]"});
      }

      void save(Archive &archive) const override
      {
        trace_.save(archive);
        reaction_.save(archive);
        for (const auto *file : {&strain_, &energy_})
          if (*file)
            (*file)->save(archive);
      }

    private:
      void write(const State &state, const Side side, std::size_t) override
      {
        std::vector<double> row = trace(system_, places_, state);
        row.insert(row.begin(), state.t);
        trace_.row(row);
        Vector r(state.u);
        system_.residual({state.t, side, state.u, state.v, state.a}, r);
        reaction_.row(std::vector<double>{state.t, r[r.size() - 1], r[0]});
        if (strain_)
          strain_->row(
              strain_row(state.t, strain_places_, system_.parameters().length, at_strain_places(state.u), at_strain_places(state.v)));
        if (energy_)
          {
            const Rod1dSystem::Energy energy = system_.energy(state);
            energy_->row(std::vector<double>{state.t, energy.kinetic, energy.stored, energy.kinetic + energy.stored});
          }
      }

      /// Values of @p x at the fixed end and at the places.
      std::vector<double> at_strain_places(const Vector &x) const
      {
        std::vector<double> values{system_.value(x, 0)};
        for (const double place : strain_places_)
          values.push_back(system_.value(x, place * system_.parameters().length));
        return values;
      }

      const Rod1dSystem        &system_;
      const std::vector<double> places_, strain_places_;
      CsvFile                   trace_, reaction_;
      std::optional<CsvFile>    strain_, energy_;
    };

    /// nodal_states.csv.
    class NodalStates : public DenseOutput
    {
    public:
      /// @p times ascend.
      NodalStates(const Rod1dSystem &system, const std::vector<double> &times, const OutputFolder &folder)
        : DenseOutput(instants(times), "end of nodal_states.csv", folder, true)
        , system_(system)
        , csv_(folder, {"nodal_states.csv", "Displacements and velocities of the nodes"}, {"Time [s]", "X [m]", "u [m]", "v [m/s]"})
      {}

      void save(Archive &archive) const override
      {
        DenseOutput::save(archive);
        csv_.save(archive);
      }

    private:
      void write(const double t, const State &state) override
      {
        for (unsigned int i = 0; i < state.u.size(); ++i)
          csv_.row(std::vector<double>{t, system_.position(i), state.u[i], state.v[i]});
      }

      const Rod1dSystem &system_;
      CsvFile            csv_;
    };

    std::vector<double> sorted(std::vector<double> numbers)
    {
      std::sort(numbers.begin(), numbers.end());
      return numbers;
    }
  } // namespace

  scene::Schema rod1d_output_schema()
  {
    scene::Schema series("Time series: trace.csv (displacement and velocity at places), reaction.csv (forces of the supports).");
    series.integer("every", 1, scene::Range::closed(1, 1e9), "A row at the start and after every so many accepted steps.")
        .text("places", "0.25 0.5 0.9 1", "Where, in parts of the length, separated by spaces.")
        .boolean("energy", false, "energy.csv: kinetic and stored energy of the rod.");
    add_strain_places(series, "points of the rod");
    scene::Schema states("All nodes at some instants: nodal_states.csv.");
    states.text("times", std::nullopt, "Instants [s], separated by spaces; interpolated where no step ends, for example \"0.1 0.2\".");
    return scene::Schema("What to write.")
        .section("series", series)
        .optional_section("nodal states", states)
        .optional_section("motion", motion_schema("displacement and velocity at the places of the series"));
  }

  std::vector<std::unique_ptr<Observer>> make_outputs(const scene::Node &output, const Rod1dSystem &system, const OutputFolder &folder,
                                                      WorkLedger &)
  {
    std::vector<std::unique_ptr<Observer>> observers;
    const scene::Node                     &series = output.section("series");
    const std::vector<double>              places = series.numbers("places", "numbers from 0 to 1");
    if (std::any_of(places.begin(), places.end(), [](const double x) { return x < 0 || x > 1; }))
      series.refuse("places", "a place is not on the rod", "numbers from 0 to 1");
    observers.push_back(std::make_unique<RodSeries>(series, system, places, folder));
    if (output.has("nodal states"))
      observers.push_back(std::make_unique<NodalStates>(
          system, sorted(output.section("nodal states").numbers("times", "times [s], separated by spaces")), folder));
    if (output.has("motion"))
      observers.push_back(make_motion(
          output.section("motion"), trace_columns(places), [&system, places](const State &state) { return trace(system, places, state); },
          folder, true));
    observers.push_back(make_energy_watch(
        system, [&system](const State &state) { return system.energy_rates(state); }, folder));
    return observers;
  }
} // namespace myolines
