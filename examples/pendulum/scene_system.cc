// SPDX-License-Identifier: LGPL-2.1-or-later
#include "pendulum.h"

#include <myolines/cli/catalogue.h>
#include <myolines/output/csv_file.h>

namespace myolines
{
  namespace
  {
    constexpr double degree = dealii::numbers::PI / 180;

    /// angle.csv: a row after every step.
    class AngleFile : public Observer
    {
    public:
      explicit AngleFile(const OutputFolder &folder)
        : csv_(folder, {"angle.csv", "Angle of the pendulum"}, {"Time [s]", "Angle [degrees]", "Angular velocity [rad/s]"})
      {}

      void begin(const State &state) override { csv_.row(std::vector<double>{state.t, state.u[0] / degree, state.v[0]}); }
      void accepted(const State &state, const StepRecord &) override { begin(state); }
      void save(Archive &archive) const override { csv_.save(archive); }

    private:
      CsvFile csv_;
    };

    AssembledSystem make(const scene::Node &system, WorkLedger &ledger, InstructionSet)
    {
      AssembledSystem assembled;
      assembled.system       = std::make_unique<Pendulum>(system.number("angle") * degree, ledger);
      assembled.make_outputs = [](const scene::Node &, const OutputFolder &folder) {
        std::vector<std::unique_ptr<Observer>> observers;
        observers.push_back(std::make_unique<AngleFile>(folder));
        return observers;
      };
      return assembled;
    }
  } // namespace

  SystemEntry pendulum_entry()
  {
    SystemEntry entry;
    entry.name   = "pendulum";
    entry.schema = [] {
      return scene::Schema("A pendulum of 1 m that is let go at rest.")
          .number("angle", 60, "degrees", scene::Range{0, 180, true, true}, "Where it begins; 0 hangs.");
    };
    entry.output   = [] { return scene::Schema("What to write: angle.csv, always."); };
    entry.example  = {{"title", "A pendulum"}, {"time/end", "2"}, {"time/step", "0.01"}};
    entry.variants = {{"", {}}};
    entry.make     = make;
    entry.size     = [](const scene::Node &, unsigned int) { return SizeEstimate{1, 0, 0, 0, true}; };
    return entry;
  }
} // namespace myolines
