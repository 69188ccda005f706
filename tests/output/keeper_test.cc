// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: runs are kept where the list `checkpoint` says, at signals and ends; solvers forget at the same steps in every run.

#include <myolines/oscillator/oscillator_system.h>
#include <myolines/output/checkpoint_keeper.h>

#include "folder.h"

#include <csignal>

using namespace myolines;

namespace
{
  struct Remembering : Integrator
  {
    void       start(State &) override {}
    StepReport step(double, State &) override { return {}; }
    void       save(Archive &archive) const override { archive.put("history", 3); }
    void       load(const Archive &) override {}
  };

  struct Halving : StepControl
  {
    double cuts = 0;

    double      propose(double) const override { return 1; }
    double      next_landing(double) const override { return 1; }
    void        accepted(double, double, const StepReport &) override {}
    bool        rejected(double, double, const StepReport &) override { return true; }
    std::string advice() const override { return "nothing"; }
    void        save(Archive &archive) const override { archive.put("cuts", cuts); }
    void        load(const Archive &) override {}
  };

  struct Counting : Observer
  {
    void save(Archive &archive) const override { archive.put("rows", 7); }
  };

  struct KeptRun
  {
    KeptRun(const std::string &every, const std::string &seconds)
      : system(OscillatorParameters(), ledger)
      , observers{&counting}
      , keeper(scene::compose_scene(checkpoint_schema(), {{"every", every}, {"seconds", seconds}}),
               {system,
                integrator,
                &control,
                observers,
                ledger,
                "<scene/>",
                {{"muscle.msh", "0123abcd"}},
                "baseline",
                [this] { ++forgotten; },
                [this] { return signal; }},
               folder.path)
    {}

    std::optional<std::string> accepted(const std::size_t step)
    {
      const State state = system.initial_state(0.1 * step);
      keeper.accepted(state, step);
      return keeper.reason_to_stop(state, step);
    }

    /// Steps in the checkpoint, 0 if there is none.
    std::size_t saved() const
    {
      const std::filesystem::path file = checkpoint_file(folder.path);
      return std::filesystem::exists(file) ? CheckpointReader(file).contents().step : 0;
    }

    test::Folder            folder;
    WorkLedger              ledger;
    OscillatorSystem        system;
    Remembering             integrator;
    Halving                 control;
    Counting                counting;
    std::vector<Observer *> observers;
    int                     forgotten = 0, signal = 0;
    CheckpointKeeper        keeper;
  };
} // namespace

TEST(Keeper, SavesEverySoManySteps)
{
  KeptRun run("3", "0");
  for (std::size_t step = 1; step <= 7; ++step)
    {
      EXPECT_EQ(run.accepted(step), std::nullopt);
      EXPECT_EQ(run.saved(), step / 3 * 3);
    }
  EXPECT_EQ(run.ledger.counted("checkpoints"), 2u);
  EXPECT_EQ(run.forgotten, 2);
  run.keeper.ended(run.system.initial_state(0.7), 7);
  EXPECT_EQ(run.saved(), 7u);

  const Checkpoint saved = CheckpointReader(checkpoint_file(run.folder.path)).contents();
  EXPECT_EQ(saved.state.t, 0.7);
  EXPECT_EQ(saved.integrator.number("history"), 3);
  EXPECT_EQ(saved.outputs.number("rows"), 7);
  EXPECT_EQ(saved.ledger.counted("checkpoints"), 3u);
  EXPECT_EQ(saved.scene, "<scene/>");
}

TEST(Keeper, ForgetsAtTheSameStepsHoweverFastTheMachineIs)
{
  KeptRun run("3", "3600");
  for (std::size_t step = 1; step <= 7; ++step)
    run.accepted(step);
  EXPECT_EQ(run.saved(), 0u);
  EXPECT_EQ(run.forgotten, 2);
}

TEST(Keeper, ASignalEndsTheRunAfterItsStep)
{
  KeptRun run("3", "0");
  EXPECT_EQ(run.accepted(1), std::nullopt);
  run.signal                              = SIGTERM;
  const std::optional<std::string> reason = run.accepted(2);
  ASSERT_TRUE(reason.has_value());
  EXPECT_NE(reason->find("Terminated"), std::string::npos) << *reason;
  EXPECT_NE(reason->find("step 2 at t = 0.2 s"), std::string::npos) << *reason;
  run.keeper.ended(run.system.initial_state(0.2), 2);
  EXPECT_EQ(run.saved(), 2u);
}

TEST(Keeper, AFailedRunIsKeptAsItWasBeforeTheRejections)
{
  KeptRun run("10", "0");
  run.control.cuts = 1;
  run.accepted(1);
  run.control.cuts = 9; // of the attempts that failed
  run.keeper.ended(run.system.initial_state(0.1), 1);
  EXPECT_EQ(CheckpointReader(checkpoint_file(run.folder.path)).contents().control.number("cuts"), 1);
}

TEST(Keeper, TheStartIsSavedForARunWhoseFirstStepFails)
{
  KeptRun run("1", "3600");
  run.keeper.begun(run.system.initial_state(0));
  const Checkpoint saved = CheckpointReader(checkpoint_file(run.folder.path)).contents();
  EXPECT_EQ(saved.step, 0u);
  EXPECT_EQ(saved.outputs.number("rows"), 7);
  EXPECT_EQ(saved.inputs, (std::map<std::string, std::string>{{"muscle.msh", "0123abcd"}}));
  run.keeper.ended(run.system.initial_state(0), 0);
  EXPECT_EQ(run.saved(), 0u);
}
