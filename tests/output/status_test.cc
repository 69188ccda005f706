// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/status.h>
#include <myolines/output/step_records.h>

#include "folder.h"

using namespace myolines;

namespace
{
  StepRecord record(const std::size_t number, const double t, const double dt)
  {
    StepRecord step;
    step.number                   = number;
    step.t                        = t;
    step.dt                       = dt;
    step.report.newton_iterations = 5;
    step.report.linear_iterations = 34;
    step.report.initial_residual  = 312;
    step.report.final_residual    = 1.25e-9;
    return step;
  }

  StepRecord rejected(const std::size_t number, const double t, const double dt)
  {
    StepRecord step     = record(number, t, dt);
    step.report.outcome = StepReport::Outcome::inadmissible;
    step.report.reason  = "det F = -0.2, cell 3";
    return step;
  }
} // namespace

TEST(Status, DurationsReadWell)
{
  EXPECT_EQ(duration_text(0.2), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(185), "3 min 05 s");
  EXPECT_EQ(duration_text(2 * 3600 + 7 * 60 + 59), "2 h 07 min");
}

TEST(Status, LogsEveryAttemptAndTheEnd)
{
  test::Folder folder;
  {
    const auto status = make_status(folder.path, 0, 0.2, true);
    status->begin(State());
    status->accepted(State(), record(1, 0.1, 0.1));
    status->rejected(rejected(1, 0.2, 0.1));
    status->end("the step is too small");
  }
  const std::vector<std::string> lines = folder.lines("run.log");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_NE(lines[0].find("from t 0 s to 0.2 s"), std::string::npos);
  EXPECT_EQ(lines[1], "step 1  t 0.1 s  dt 0.1 s  Newton 5  linear 34  residual 3.12e+02 -> 1.25e-09");
  EXPECT_NE(lines[2].find("rejected: inadmissible, det F = -0.2, cell 3"), std::string::npos);
  EXPECT_NE(lines[3].find("stopped: the step is too small"), std::string::npos);
}

TEST(Status, TerminalShowsProgressOnOneLine)
{
  test::Folder       folder;
  std::ostringstream terminal;
  Status             status(folder.path, 1, 3, &terminal);
  status.begin(State());
  status.accepted(State(), record(1, 1.5, 0.5));
  status.accepted(State(), record(2, 3, 1.5));
  status.end("");

  const std::string shown = terminal.str();
  EXPECT_EQ(std::count(shown.begin(), shown.end(), '\r'), 2);
  EXPECT_EQ(std::count(shown.begin(), shown.end(), '\n'), 1);
  const std::size_t second = shown.rfind('\r');
  EXPECT_EQ(shown.compare(0, 6, "\r25 % "), 0) << shown;
  EXPECT_NE(shown.substr(0, second).find("remaining"), std::string::npos);
  EXPECT_EQ(shown.compare(second, 7, "\r100 % "), 0) << shown;
  // The second line covers all of the first, which was longer.
  EXPECT_GE(shown.size() - 1 - second, second);
}

TEST(Status, NothingOnATerminalThatIsNotThere)
{
  test::Folder folder;
  Status       status(folder.path, 0, 1, nullptr);
  status.begin(State());
  status.accepted(State(), record(1, 1, 1));
  status.end("");
  EXPECT_EQ(folder.lines("run.log").size(), 3u);
}

namespace
{
  StepRecord by_error(const std::size_t number, const double dt, const double error)
  {
    StepRecord step            = record(number, number * dt, dt);
    step.report.error_estimate = error;
    return step;
  }
} // namespace

/// A hundred steps of a microsecond in a run of a second: told once, with their number, their time and what holds them.
TEST(Status, WarnsOfStepsByErrorThatHaveBecomeVeryMany)
{
  test::Folder             folder;
  std::vector<std::string> told;
  const auto               status = make_status(folder.path, 0, 1, true, [&](const std::string &warning) { told.push_back(warning); });
  status->begin(State());
  for (std::size_t i = 1; i <= 300; ++i)
    {
      status->accepted(State(), by_error(i, 1e-6, 0.5));
      EXPECT_EQ(told.size(), i < 100 ? 0u : 1u) << i;
    }
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("steps are 1e-06 s long at t = 0.0001 s"), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("about 1e+06 more"), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("the error was 0.5 of the tolerance"), std::string::npos) << told[0];
  EXPECT_NE(folder.lines("run.log")[101].find("warning: steps are"), std::string::npos);
}

TEST(Status, TellsWhatHoldsStepsShort)
{
  const auto told = [](const double error, const std::size_t every, const StepReport::Outcome outcome) {
    Pace                       pace(1);
    std::optional<std::string> warning;
    for (std::size_t i = 1; i <= 100; ++i)
      {
        StepRecord refused     = by_error(i, 1e-6, 2);
        refused.report.outcome = outcome;
        if (every > 0 && i % every == 0)
          pace.rejected(refused);
        warning = pace.accepted(by_error(i, 1e-6, error), 10);
      }
    return warning.value_or("");
  };
  EXPECT_NE(told(0.001, 2, StepReport::Outcome::not_converged).find("50 more failed to be solved"), std::string::npos);
  EXPECT_NE(told(0.001, 10, StepReport::Outcome::error_too_large).find("10 more were refused"), std::string::npos);
  EXPECT_NE(told(0.001, 0, StepReport::Outcome::accepted).find("it is not what holds them short"), std::string::npos);
}

/// Steps that grow, that are enough, or that are given.
TEST(Status, DoesNotWarnOfStepsThatAreWell)
{
  Pace   growing(1), enough(1), given(1);
  double size = 1e-9;
  for (std::size_t i = 1; i <= 100; ++i, size *= 1.05)
    {
      StepRecord grown = by_error(i, 1e-6, 0.5), fixed = record(i, 1e-6 * i, 1e-6);
      grown.dt = size;
      EXPECT_FALSE(growing.accepted(grown, 1));
      EXPECT_FALSE(enough.accepted(by_error(i, 1e-3, 0.5), 1));
      EXPECT_FALSE(given.accepted(fixed, 1));
    }
}

TEST(StepsFile, OneRowPerAttempt)
{
  test::Folder folder;
  const auto   steps = make_steps_file(folder.path);
  steps->accepted(State(), record(1, 0.1, 0.1));
  steps->rejected(rejected(1, 0.2, 0.1));
  StepRecord last            = record(2, 0.15, 0.05);
  last.report.error_estimate = 0.5;
  steps->accepted(State(), last);

  const std::vector<std::string> lines = folder.lines("steps.csv");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0],
            "Step,Time [s],dt [s],Outcome,Newton iterations,Linear iterations,Residual evaluations,Initial residual,Final residual,"
            "Error estimate,Reason");
  EXPECT_EQ(lines[1], "1,0.1,0.1,accepted,5,34,0,312,1.25e-09,,");
  EXPECT_EQ(lines[2], "1,0.2,0.1,inadmissible,5,34,0,312,1.25e-09,,\"det F = -0.2, cell 3\"");
  EXPECT_EQ(lines[3], "2,0.15,0.05,accepted,5,34,0,312,1.25e-09,0.5,");
}

TEST(StepsFile, MethodsWithoutAResidualShowNone)
{
  test::Folder       folder;
  const OutputFolder outputs(folder.path);
  const auto         steps          = make_steps_file(outputs);
  StepRecord         explicit_      = record(1, 0.1, 0.1);
  explicit_.report.initial_residual = explicit_.report.final_residual = std::nullopt;
  steps->accepted(State(), explicit_);
  EXPECT_EQ(folder.lines("steps.csv")[1], "1,0.1,0.1,accepted,5,34,0,,,,");
  EXPECT_EQ(outputs.left_empty().at("steps.csv").size(), 2u);
  EXPECT_EQ(step_text(explicit_).find("residual"), std::string::npos);
}
