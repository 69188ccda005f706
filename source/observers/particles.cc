// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/outputs.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/energy_watch.h>
#include <myolines/output/periodic_output.h>

namespace myolines
{
  namespace
  {
    /// trajectory.csv: u, v and a of every unknown, forces on the prescribed ones (their rows of the residual), energy.
    class Trajectories : public PeriodicOutput
    {
    public:
      Trajectories(const ParticleSystem &system, const unsigned int every, const OutputFolder &folder)
        : PeriodicOutput(every)
        , system_(system)
        , csv_(folder, {"trajectory.csv", "Motion of the masses"}, columns(system))
      {}

      void save(Archive &archive) const override { csv_.save(archive); }

    private:
      static std::vector<std::string> columns(const ParticleSystem &system)
      {
        std::vector<std::string> all{"Time [s]"};
        for (const std::string &name : system.names())
          for (const char *quantity : {" displacement [m]", " velocity [m/s]", " acceleration [m/s^2]"})
            all.push_back(name + quantity);
        for (const auto &line : system.constraints().get_lines())
          all.push_back(system.names()[line.index] + " force [N]");
        all.push_back("Energy [J]");
        return all;
      }

      void write(const State &state, const Side side, std::size_t) override
      {
        std::vector<double> row{state.t};
        for (unsigned int i = 0; i < state.u.size(); ++i)
          for (const Vector *x : {&state.u, &state.v, &state.a})
            row.push_back((*x)(i));
        Vector r(state.u);
        system_.residual({state.t, side, state.u, state.v, state.a}, r);
        for (const auto &line : system_.constraints().get_lines())
          row.push_back(r(line.index));
        row.push_back(system_.energetics(state, side).energy);
        csv_.row(row);
      }

      const ParticleSystem &system_;
      CsvFile               csv_;
    };
  } // namespace

  scene::Schema particle_output_schema()
  {
    scene::Schema series("Time series: trajectory.csv.");
    series.integer("every", 1, scene::Range::closed(1, 1e9), "A row at the start, after every so many accepted steps, and at the end.");
    return scene::Schema("What to write.").section("series", series);
  }

  std::vector<std::unique_ptr<Observer>> make_outputs(const scene::Node &output, const ParticleSystem &system, const OutputFolder &folder,
                                                      WorkLedger &)
  {
    std::vector<std::unique_ptr<Observer>> observers;
    observers.push_back(std::make_unique<Trajectories>(system, output.section("series").integer("every"), folder));
    observers.push_back(make_energy_watch(
        system, [&system](const State &state) { return system.energetics(state, Side::left).rates; }, folder));
    return observers;
  }
} // namespace myolines
