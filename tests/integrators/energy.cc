// SPDX-License-Identifier: LGPL-2.1-or-later
// The balance of energy of the oscillator with methods whose dissipation is known, and the guard against steps that gain.

#include "experiment.h"

#include <myolines/base/error.h>
#include <myolines/time/energy_guard.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  struct EnergyLog : Observer
  {
    explicit EnergyLog(const SemiDiscreteSystem &system)
      : system(system)
    {}
    void begin(const State &state) override { balance.restarted(state.t, system.energetics(state, Side::right)); }
    void restarted(const State &state) override { begin(state); }
    void accepted(const State &state, const StepRecord &) override
    {
      const double before = balance.report().drift;
      balance.accepted(state.t, system.energetics(state, Side::left));
      gains.push_back(balance.report().drift - before);
    }

    const SemiDiscreteSystem &system;
    EnergyBalance             balance;
    std::vector<double>       gains;
  };

  EnergyReport report_of(const std::string &method, const OscillatorParameters &parameters, const double end, const double step,
                         const Overrides &of_method = {})
  {
    Experiment experiment(integrator_entry(method), parameters, BoundaryRates::exact, of_method);
    EnergyLog  watch(experiment.system);
    experiment.run(end, step, {&watch});
    return watch.balance.report();
  }

  /// u' = v, v' = -u by Euler's explicit method, whose energy grows by 1 + h^2 in every step.
  struct ForwardEuler : Integrator
  {
    void       start(State &) override {}
    StepReport step(const double dt, State &state) override
    {
      const double u = state.u(0), v = state.v(0);
      state.u(0) = u + dt * v;
      state.v(0) = v - dt * u;
      state.t += dt;
      ++steps;
      return {};
    }
    void save(Archive &archive) const override { archive.put("steps", steps); }
    void load(const Archive &archive) override { steps = archive.number("steps"); }

    double steps = 0;
  };

  struct Guarded
  {
    explicit Guarded(const Overrides &settings)
      : time(node(time_schema(), settings))
      , system({}, solvers.ledger)
      , control(make_step_control(time))
      , integrator(guard_energy(std::make_unique<ForwardEuler>(), time, system))
      , state(system.initial_state(0))
      , watch(system)
    {}
    void run() { run_loop(system, *integrator, *control, loop_settings(time), state, {&watch}, solvers.ledger); }

    Solvers                      solvers;
    scene::Node                  time;
    OscillatorSystem             system;
    std::unique_ptr<StepControl> control;
    std::unique_ptr<Integrator>  integrator;
    State                        state;
    EnergyLog                    watch;
  };
} // namespace

TEST(Energy, backwardEulerLosesWhatTheorySays)
{
  // Of u'' + u = 0 every step leaves 1 / (1 + h^2) of the energy.
  const double       h = 0.1, start = 0.5;
  const EnergyReport report = report_of("backward euler", {}, 2, h);
  EXPECT_NEAR(report.drift, start * (std::pow(1 + h * h, -20) - 1), 1e-12);
  EXPECT_EQ(report.exchanged, start);
  EXPECT_EQ(report.rise.size, 0);
}

TEST(Energy, theTrapezoidalRuleKeepsThatOfALinearSpring)
{
  const EnergyReport report = report_of("newmark", {}, 20, 0.1, {"first step=own"});
  EXPECT_NEAR(report.drift, 0, 1e-12);
  EXPECT_LT(report.rise.size, 1e-12);
}

TEST(Energy, forcesOfTwoStatesKeepThatOfACubicSpring)
{
  OscillatorParameters cubic;
  cubic.cubic_stiffness = 30;
  for (const Overrides &of_method : {Overrides{}, Overrides{"composition=suzuki"}})
    EXPECT_NEAR(report_of("energy momentum", cubic, 50, 0.25, of_method).drift, 0, 1e-11);
  EXPECT_GT(std::abs(report_of("implicit midpoint", cubic, 50, 0.25).drift), 1e-2);
  cubic.damping       = 0.1; // acts in the middle
  cubic.force         = sine(1, 2);
  const double coarse = report_of("energy momentum", cubic, 2, 0.02).drift, fine = report_of("energy momentum", cubic, 2, 0.01).drift;
  EXPECT_NEAR(coarse / fine, 4, 0.4);
}

TEST(Energy, balancesWithForceSupportAndDamperCloseWithTheOrderOfTheMethod)
{
  const double coarse = report_of("newmark", driven_duffing(), 2, 0.02).drift, fine = report_of("newmark", driven_duffing(), 2, 0.01).drift;
  EXPECT_NEAR(coarse / fine, 4, 0.2);
  EXPECT_LT(std::abs(fine), 1e-3 * report_of("newmark", driven_duffing(), 2, 0.01).exchanged);
}

TEST(Energy, aGainIsSeenWithItsTimes)
{
  Guarded      run({"end=1", "step=0.1", "control/type=fixed"});
  const double growth = 1 + 0.1 * 0.1;
  run.run();
  const EnergyReport &report = run.watch.balance.report();
  EXPECT_NEAR(report.drift, 0.5 * (std::pow(growth, 10) - 1), 1e-12);
  EXPECT_EQ(report.rise.from, 0);
  EXPECT_EQ(report.rise.to, 1);
  EXPECT_EQ(report.rise.size, report.drift);
  EXPECT_NEAR(report.jump.size, 0.5 * std::pow(growth, 9) * (growth - 1), 1e-12) << "the last step gains most";
  EXPECT_EQ(report.jump.to, 1);
}

TEST(EnergyGuard, stepsThatGainTooMuchAreCut)
{
  // h^2/2 (1 + ...) <= 1e-3: steps of 0.1 gain 5e-3, of 0.025 3e-4
  Guarded run({"end=0.5", "step=0.1", "control/type=cut back", "control/largest gain=1e-3"});
  run.run();
  EXPECT_GT(run.solvers.ledger.counted("rejected steps"), 0u);
  EXPECT_EQ(run.state.t, 0.5);
  for (const double gain : run.watch.gains)
    EXPECT_LE(gain, 1e-3);
}

TEST(EnergyGuard, aRefusedStepLeavesNoTrace)
{
  Guarded run({"end=1", "step=0.1", "control/largest gain=1e-3"});
  run.integrator->start(run.state);
  const std::vector<double> before = values(run.state);
  const StepReport          report = run.integrator->step(0.1, run.state);
  EXPECT_EQ(report.outcome, StepReport::Outcome::energy_gained);
  EXPECT_NE(report.reason.find("gains 0.005 J, more than 0.001 J"), std::string::npos) << report.reason;
  EXPECT_EQ(values(run.state), before);
  Archive archive;
  run.integrator->save(archive);
  EXPECT_EQ(archive.number("steps"), 0);
}

TEST(EnergyGuard, theRunEndsAfterTheUsualCuts)
{
  for (const Overrides &settings :
       {Overrides{"end=1", "step=0.1", "control/type=cut back", "control/maximum cuts=3", "control/largest gain=1e-9"},
        Overrides{"end=1", "step=0.1", "control/type=fixed", "control/largest gain=1e-9"}})
    {
      Guarded run(settings);
      try
        {
          run.run();
          ADD_FAILURE() << "no step is that good";
        }
      catch (const SolveError &error)
        {
          EXPECT_NE(std::string(error.what()).find("the balance of energy gains"), std::string::npos) << error.what();
        }
      EXPECT_EQ(run.state.t, 0);
      EXPECT_EQ(run.solvers.ledger.counted("rejected steps"), settings[2] == "control/type=fixed" ? 1u : 4u);
    }
}

TEST(EnergyGuard, costsNothingWhereItIsNotAskedFor)
{
  const scene::Node time   = node(time_schema(), {"end=1", "step=0.1"});
  auto              method = std::make_unique<ForwardEuler>();
  const Integrator *plain  = method.get();
  Solvers           solvers;
  OscillatorSystem  system({}, solvers.ledger);
  EXPECT_EQ(guard_energy(std::move(method), time, system).get(), plain);
}

// It is not needed by the method itself, but printed, and tables of accelerations are made of it.
TEST(Accelerations, ofRosenbrocksMethodAreOfSecondOrderAtTheEnd)
{
  const auto error = [](const double step) {
    OscillatorParameters parameters;
    parameters.damping = 0.1;
    Experiment experiment(integrator_entry("rosenbrock"), parameters);
    experiment.run(2, step);
    const State &s = experiment.state;
    // u'' = -u - 0.1 u' from u = 1, u' = 0
    const double w = std::sqrt(1 - 0.05 * 0.05), decay = std::exp(-0.05 * 2),
                 exact = -decay * (std::cos(2 * w) - 0.05 / w * std::sin(2 * w));
    return std::abs(s.a(0) - exact);
  };
  const double coarse = error(0.05), fine = error(0.025);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3) << coarse << " " << fine;
}
