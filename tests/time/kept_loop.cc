// SPDX-License-Identifier: LGPL-2.1-or-later
// What the loop tells its keeper and its observers, and when.
#include "loop_fixtures.h"

namespace
{
  /// Writes down in one list what keeper and observer are told.
  struct Diary : Keeper, Observer
  {
    void accepted(const State &, const std::size_t step) override { entries.push_back("keep " + std::to_string(step)); }
    std::optional<std::string> reason_to_stop(const State &state, std::size_t) override
    {
      return state.t >= stop_at ? std::optional<std::string>("asked to") : std::nullopt;
    }
    void ended(const State &, const std::size_t step) override { entries.push_back("kept " + std::to_string(step)); }

    void begin(const State &) override { entries.push_back("begin"); }
    void resume(const State &, const std::size_t step) override { entries.push_back("resume " + std::to_string(step)); }
    void accepted(const State &, const StepRecord &record) override
    {
      if (record.t >= break_at)
        throw std::logic_error("broken");
      entries.push_back("step " + std::to_string(record.number));
    }
    void last(const State &state) override { entries.push_back(state.t == 1 ? "last, at the end" : "last"); }
    void end(const std::string &reason) override { entries.push_back("end: " + reason); }

    double                   stop_at = 10, break_at = 10;
    std::vector<std::string> entries;
  };

  struct KeptTrial
  {
    Fake       fake;
    Diary      diary;
    WorkLedger ledger;

    void go(const double from = 0, const std::size_t steps_done = 0)
    {
      const scene::Node time = node(time_schema(), {"end=1", "step=0.5", "control/type=fixed"});
      const Eventful    system({});
      const auto        control  = make_step_control(time);
      State             state    = system.initial_state(from);
      LoopSettings      settings = loop_settings(time);
      settings.steps_done        = steps_done;
      run_loop(system, fake, *control, settings, state, {&diary}, ledger, &diary);
    }
  };

  using Entries = std::vector<std::string>;
} // namespace

TEST(Loop, keepsTheRunAfterItsObserversAndBeforeTheLastState)
{
  KeptTrial run;
  run.go();
  EXPECT_EQ(run.diary.entries, (Entries{"begin", "step 1", "keep 1", "step 2", "kept 2", "last, at the end", "end: "}));
}

TEST(Loop, numbersTheStepsOfAResumedRunOn)
{
  KeptTrial run;
  run.go(0.5, 7);
  EXPECT_EQ(run.diary.entries, (Entries{"resume 7", "step 8", "kept 8", "last, at the end", "end: "}));
}

TEST(Loop, stopsWhenTheKeeperSaysSo)
{
  KeptTrial run;
  run.diary.stop_at = 0.5;
  EXPECT_THROW(run.go(), Interrupted);
  EXPECT_EQ(run.diary.entries, (Entries{"begin", "step 1", "keep 1", "kept 1", "last", "end: asked to"}));
}

TEST(Loop, keepsTheLastAcceptedStateOfAFailedRun)
{
  KeptTrial run;
  run.fake.fails = [](const double t, double) { return t > 0; };
  EXPECT_THROW(run.go(), SolveError);
  ASSERT_EQ(run.diary.entries.size(), 6u);
  EXPECT_EQ(Entries(run.diary.entries.begin(), run.diary.entries.end() - 1), (Entries{"begin", "step 1", "keep 1", "kept 1", "last"}));
}

/// A signal makes a long solve fail: that is no failed step.
TEST(Loop, anAttemptThatFailsBecauseTheRunIsAskedToStopEndsItThere)
{
  KeptTrial run;
  run.fake.fails = [&](const double t, double) {
    if (t > 0)
      run.diary.stop_at = 0.5;
    return t > 0;
  };
  EXPECT_THROW(run.go(), Interrupted);
  EXPECT_EQ(run.diary.entries, (Entries{"begin", "step 1", "keep 1", "kept 1", "last", "end: asked to"}));
  EXPECT_EQ(run.ledger.counted("rejected steps"), 0u);
}

TEST(Loop, asksNothingMoreOfRanksThatMayNotKnowOfAnError)
{
  KeptTrial run;
  run.diary.break_at = 0.5;
  EXPECT_THROW(run.go(), std::logic_error);
  EXPECT_EQ(run.diary.entries, (Entries{"begin", "end: broken"}));
}
