// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/outputs.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/dense_output.h>
#include <myolines/output/energy_watch.h>
#include <myolines/output/periodic_output.h>

namespace myolines
{
  namespace
  {
    std::vector<std::string> columns(const bool with_support)
    {
      std::vector<std::string> names{"Time [s]", "Displacement [m]", "Velocity [m/s]", "Acceleration [m/s^2]"};
      if (with_support)
        names.insert(names.end(), {"Support displacement [m]", "Support force [N]"});
      return names;
    }

    /// trajectory.csv. The support force is the one the support exerts: its row of the residual.
    class Trajectory : public PeriodicOutput
    {
    public:
      Trajectory(const OscillatorSystem &system, const unsigned int every, const OutputFolder &folder)
        : PeriodicOutput(every)
        , system_(system)
        , with_support_(system.parameters().support != nullptr)
        , csv_(folder, {"trajectory.csv", "Motion of the mass"}, columns(with_support_))
      {}

      void save(Archive &archive) const override { csv_.save(archive); }

    private:
      void write(const State &state, const Side side, std::size_t) override
      {
        std::vector<double> row{state.t, state.u[0], state.v[0], state.a[0]};
        if (with_support_)
          {
            Vector r(state.u);
            system_.residual({state.t, side, state.u, state.v, state.a}, r);
            row.insert(row.end(), {state.u[1], r[1]});
          }
        csv_.row(row);
      }

      const OscillatorSystem &system_;
      bool                    with_support_;
      CsvFile                 csv_;
    };
  } // namespace

  scene::Schema oscillator_output_schema()
  {
    scene::Schema series("Time series: trajectory.csv.");
    series.integer("every", 1, scene::Range::closed(1, 1e9), "A row at the start, after every so many accepted steps, and at the end.");
    return scene::Schema("What to write.")
        .section("series", series)
        .optional_section("motion", motion_schema("displacement and velocity of the mass"));
  }

  std::vector<std::unique_ptr<Observer>> make_outputs(const scene::Node &output, const OscillatorSystem &system, const OutputFolder &folder,
                                                      WorkLedger &)
  {
    std::vector<std::unique_ptr<Observer>> observers;
    observers.push_back(std::make_unique<Trajectory>(system, output.section("series").integer("every"), folder));
    if (output.has("motion"))
      observers.push_back(make_motion(
          output.section("motion"), {"Displacement [m]", "Velocity [m/s]"},
          [](const State &state) {
            return std::vector<double>{state.u[0], state.v[0]};
          },
          folder, true));
    observers.push_back(make_energy_watch(
        system, [&system](const State &state) { return system.energetics(state, Side::left).rates; }, folder));
    return observers;
  }
} // namespace myolines
