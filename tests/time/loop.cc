// SPDX-License-Identifier: LGPL-2.1-or-later
#include "loop_fixtures.h"

TEST(Loop, landsOnTheEndWithoutRoundOff)
{
  for (const char *step : {"0.1", "0.3", "0.07", "0.0001", "1e-3", "5"})
    {
      Trial run;
      run.go({"end=0.7", std::string("step=") + step});
      EXPECT_EQ(run.state.t, 0.7) << step;
      EXPECT_EQ(run.fake.ends, run.recorder.times) << "the integrator's own t + dt is the landing, bit for bit";
      EXPECT_EQ(run.recorder.times.size(), std::ceil(0.7 / std::stod(step) - 1e-9)) << step;
      EXPECT_EQ(run.ledger.counted("accepted steps"), run.recorder.times.size());
      EXPECT_EQ(run.recorder.numbers.back(), run.recorder.times.size());
      EXPECT_EQ(run.recorder.reason, "");
    }
}

TEST(Loop, stepTimesAreMultiplesNotSums)
{
  Trial run;
  run.go({"end=1000", "step=0.1"});
  ASSERT_EQ(run.recorder.times.size(), 10000u);
  for (unsigned int k = 0; k < 10000; ++k)
    ASSERT_EQ(run.recorder.times[k], k == 9999 ? 1000. : (k + 1) * 0.1);
}

TEST(Loop, restartsAtEvents)
{
  Trial run;
  run.go({"end=1", "step=0.25"}, {0.1, 0.5, 0.9});
  EXPECT_EQ(run.recorder.times, (std::vector<double>{0.1, 0.25, 0.5, 0.75, 0.9, 1}));
  EXPECT_EQ(run.fake.starts, (std::vector<double>{0, 0.1, 0.5, 0.9}));
  EXPECT_EQ(run.ledger.counted("restarts at events"), 3u);
}

TEST(Loop, landsOnEventsOrIgnoresThem)
{
  Trial land, ignore;
  land.go({"end=1", "step=0.5", "events=land"}, {0.1});
  EXPECT_EQ(land.recorder.times, (std::vector<double>{0.1, 0.5, 1}));
  EXPECT_EQ(land.fake.starts, std::vector<double>{0});
  ignore.go({"end=1", "step=0.5", "events=ignore"}, {0.1});
  EXPECT_EQ(ignore.recorder.times, (std::vector<double>{0.5, 1}));
}

// A time one rounding beside another is the same time: the event counts, and no step is taken between the two.
TEST(Loop, timesThatAgreeAreOneTime)
{
  const double kink = 0.1 + 0.2; // another double than 0.3
  for (const char *events : {"events=restart", "events=land"})
    for (const double beside : {std::nextafter(kink, 0.), kink, std::nextafter(kink, 1.)})
      for (const char *step : {"0.25", "0.1", "0.02"})
        {
          std::ostringstream land;
          land.precision(17);
          land << "land on=" << beside;
          Trial run, plain;
          run.go({"end=0.5", std::string("step=") + step, events, land.str()}, {kink});
          plain.go({"end=0.5", std::string("step=") + step, events}, {kink});
          EXPECT_EQ(run.recorder.times, plain.recorder.times) << beside - kink << " " << step;
          EXPECT_EQ(run.fake.starts, plain.fake.starts) << beside - kink << " " << step;
        }
  Trial two; // of two events the later one, so that both are behind
  two.go({"end=0.5", "step=0.25"}, {0.3, kink});
  EXPECT_EQ(two.recorder.times, (std::vector<double>{0.25, kink, 0.5}));
  EXPECT_EQ(two.fake.starts, (std::vector<double>{0, kink}));
  Trial distinct; // two events are two, and both are landed on, however near
  distinct.go({"end=0.5", "step=0.25", "land on=0.300000000002"}, {0.3, 0.300000000001});
  EXPECT_EQ(distinct.recorder.times, (std::vector<double>{0.25, 0.3, 0.300000000001, 0.5}));
  EXPECT_EQ(distinct.fake.starts, (std::vector<double>{0, 0.3, 0.300000000001}));
  const double before = std::nextafter(0.5, 0.); // a landing or an event just before the end is the end
  for (const std::vector<double> &events : {std::vector<double>{}, std::vector<double>{before}})
    {
      std::ostringstream land;
      land.precision(17);
      land << "land on=" << before;
      Trial last;
      last.go({"end=0.5", "step=0.25", land.str()}, events);
      EXPECT_EQ(last.recorder.times, (std::vector<double>{0.25, 0.5}));
      EXPECT_EQ(last.fake.starts, std::vector<double>{0});
    }
  Trial late; // roundings grow with the times
  late.go({"start=1e10", "end=10000000001", "step=0.5", "land on=10000000000.500002"}, {1e10 + 0.5});
  EXPECT_EQ(late.recorder.times, (std::vector<double>{1e10 + 0.5, 1e10 + 1}));
}

// After 3e8 steps round-off of the time is more than a billionth of a step: no step is cut, none is added.
TEST(Loop, veryManyStepsGoOnAsPlanned)
{
  for (const char *type : {"fixed", "cut back"})
    for (const double first : {3e6, 3e7, 3e8})
      {
        const double       size = 1e-6 / 3;
        std::ostringstream end, step;
        end.precision(17);
        step.precision(17);
        end << "end=" << (first + 300) * size;
        step << "step=" << size;
        Trial run;
        run.state = Eventful({}).initial_state(first * size);
        run.go({end.str(), step.str(), std::string("control/type=") + type});
        ASSERT_EQ(run.recorder.times.size(), 300u) << type << " " << first;
        for (unsigned int k = 0; k < 300; ++k)
          EXPECT_NEAR(run.recorder.times[k], (first + k + 1) * size, 1e-6 * size);
      }
}

TEST(Loop, makesNoSliversWhereTimesNearlyAgree)
{
  // 3 * 0.1 is the next double after 0.3: the event wins over the planned step, the end over the event.
  const double above = 3 * 0.1;
  ASSERT_NE(above, 0.3);
  Trial run;
  run.go({"end=0.4", "step=0.1"}, {0.3});
  ASSERT_EQ(run.recorder.times.size(), 4u);
  EXPECT_EQ(run.recorder.times[2], 0.3);
  EXPECT_EQ(run.fake.starts, (std::vector<double>{0, 0.3}));
  for (const double dt : run.fake.sizes)
    EXPECT_NEAR(dt, 0.1, 1e-15);
}

TEST(Loop, recordsEveryRejectionAndGoesOn)
{
  Trial run;
  run.fake.fails = [](const double t, const double dt) { return t >= 0.5 && t < 0.75 && dt > 0.07; };
  run.go({"end=1", "step=0.25"});
  EXPECT_EQ(run.state.t, 1);
  ASSERT_GE(run.recorder.rejections.size(), 2u);
  EXPECT_EQ(run.ledger.counted("rejected steps"), run.recorder.rejections.size());
  for (const StepRecord &record : run.recorder.rejections)
    {
      EXPECT_GE(record.t - record.dt, 0.5 - 1e-12);
      EXPECT_EQ(record.report.reason, "on demand");
    }
  EXPECT_EQ(run.recorder.numbers.back(), run.recorder.times.size()) << "rejected attempts are not numbered";
  EXPECT_TRUE(std::count(run.recorder.times.begin(), run.recorder.times.end(), 0.75)) << "sub-steps land on the plan";
  EXPECT_EQ(run.state.u(0), run.recorder.times.size());
}

TEST(Loop, saysWhyWhereAndWhatToTryWhenItGivesUp)
{
  Trial run;
  run.fake.fails = [](const double t, const double) { return t > 0.3; };
  try
    {
      run.go({"end=1", "step=0.25", "control/maximum cuts=2"});
      FAIL() << "the loop must give up";
    }
  catch (const SolveError &error)
    {
      const std::string text = error.what();
      for (const char *part : {"t = 0.5 s", "0.0625 s", "on demand", "time/step"})
        EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
      EXPECT_EQ(run.recorder.reason, text);
    }
  EXPECT_EQ(run.recorder.ended, 1u);
  EXPECT_EQ(run.recorder.rejections.size(), 3u);
  EXPECT_EQ(run.state.t, 0.5);
}

TEST(Loop, restartsOnceAtAnEventAlsoIfTheStepFromThereIsRepeated)
{
  Trial run;
  run.fake.fails = [](const double t, const double dt) { return t == 0.5 && dt > 0.1; };
  run.go({"end=1", "step=0.25"}, {0.5});
  EXPECT_EQ(run.recorder.rejections.size(), 2u);
  EXPECT_EQ(run.fake.starts, (std::vector<double>{0, 0.5}));
}

TEST(Loop, landsOnTimesAsAskedWithoutRestart)
{
  Trial run;
  run.go({"end=1", "step=0.25", "land on=0.6 0.3 1"}, {0.6});
  EXPECT_EQ(run.recorder.times, (std::vector<double>{0.25, 0.3, 0.5, 0.6, 0.75, 1}));
  EXPECT_EQ(run.fake.starts, (std::vector<double>{0, 0.6}));
  for (const char *wrong : {"land on=0", "land on=1.5", "land on=0.3, 0.4", "land on=soon"})
    EXPECT_THROW(loop_settings(node(time_schema(), {"end=1", "step=0.25", wrong})), InputError) << wrong;
}

TEST(Loop, makesTwoEqualStepsRatherThanALongAndAShortOneWhereStepsAreFree)
{
  Trial run;
  run.go({"end=1", "step=0.4", "control/type=error", "control/growth factor=1.01"}, {0.5});
  EXPECT_EQ(run.recorder.times, (std::vector<double>{0.25, 0.5, 0.75, 1}));
}

TEST(Loop, resumesALaterStateWithoutStartingAnew)
{
  Trial run;
  run.state = Eventful({}).initial_state(0.5);
  run.go({"end=1", "step=0.25"}, {0.25});
  EXPECT_TRUE(run.fake.starts.empty());
  EXPECT_EQ(run.recorder.times, (std::vector<double>{0.75, 1}));

  Trial at_event; // saved on landing, before the restart
  at_event.state = Eventful({}).initial_state(0.5);
  at_event.go({"end=1", "step=0.25"}, {0.5});
  EXPECT_EQ(at_event.fake.starts, std::vector<double>{0.5});
}
