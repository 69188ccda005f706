// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/csv_file.h>
#include <myolines/output/status.h>
#include <myolines/output/step_records.h>
#include <myolines/output/text_file.h>

namespace myolines
{
  namespace
  {
    class StepsFile : public Observer
    {
    public:
      explicit StepsFile(const OutputFolder &folder)
        : folder_(folder)
        , csv_(folder, file,
               {"Step", "Time [s]", "dt [s]", "Outcome", "Newton iterations", "Linear iterations", "Residual evaluations",
                "Initial residual", "Final residual", "Error estimate", "Reason"})
      {}

      void accepted(const State &, const StepRecord &record) override
      {
        if (!record.report.final_residual)
          for (const char *column : {"Initial residual", "Final residual"})
            folder_.leave_empty(file, column);
        write(record);
      }
      void rejected(const StepRecord &record) override { write(record); }
      void save(Archive &archive) const override { csv_.save(archive); }

    private:
      void write(const StepRecord &record)
      {
        const StepReport &report = record.report;
        const auto        cell   = [](const std::optional<double> &number) { return number ? exact_text(*number) : ""; };
        csv_.row(std::vector<std::string>{
            std::to_string(record.number), exact_text(record.t), exact_text(record.dt), outcome_text(report.outcome),
            std::to_string(report.newton_iterations), std::to_string(report.linear_iterations), std::to_string(report.residual_evaluations),
            cell(report.initial_residual), cell(report.final_residual), cell(report.error_estimate), report.reason});
      }

      static constexpr const char *file = "steps.csv";

      OutputFolder folder_;
      CsvFile      csv_;
    };
  } // namespace

  std::unique_ptr<Observer> make_steps_file(const OutputFolder &folder) { return std::make_unique<StepsFile>(folder); }
} // namespace myolines
