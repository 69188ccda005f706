#include <myolines/output/csv_file.h>
#include <myolines/output/outputs.h>
#include <myolines/output/status.h>
#include <myolines/output/text_file.h>

namespace myolines
{
  namespace
  {
    class StepsFile : public Observer
    {
    public:
      explicit StepsFile(const OutputFolder &folder)
        : csv_(folder, "steps.csv",
               {"Step", "Time [s]", "dt [s]", "Outcome", "Newton iterations", "Linear iterations", "Residual evaluations",
                "Initial residual", "Final residual", "Error estimate", "Reason"})
      {}

      void accepted(const State &, const StepRecord &record) override { write(record); }
      void rejected(const StepRecord &record) override { write(record); }
      void save(Archive &archive) const override { csv_.save(archive); }

    private:
      void write(const StepRecord &record)
      {
        const StepReport &report = record.report;
        csv_.row(std::vector<std::string>{std::to_string(record.number), exact_text(record.t), exact_text(record.dt),
                                          outcome_text(report.outcome), std::to_string(report.newton_iterations),
                                          std::to_string(report.linear_iterations), std::to_string(report.residual_evaluations),
                                          exact_text(report.initial_residual), exact_text(report.final_residual),
                                          report.error_estimate ? exact_text(*report.error_estimate) : "", report.reason});
      }

      CsvFile csv_;
    };
  } // namespace

  std::unique_ptr<Observer> make_steps_file(const OutputFolder &folder) { return std::make_unique<StepsFile>(folder); }
} // namespace myolines
