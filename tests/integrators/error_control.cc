// SPDX-License-Identifier: LGPL-2.1-or-later
// What every method must show whose steps are chosen by error: its estimates, work and errors in proportion to the tolerance, steps
// that are refused leave no trace, and runs go on bit for bit.

#include "exact.h"
#include "experiment.h"

#include <myolines/base/error.h>
#include <myolines/time/error_control.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  /// An oscillator whose steps are chosen by error, as a run puts the parts together.
  struct Adaptive
  {
    /// @p settings of the list `time`, beside the end, the kind of control and the first step.
    Adaptive(const Verified &method, OscillatorParameters parameters, const double end, const Overrides &settings)
      : time(node(time_schema(), by_error(settings, end)))
      , system(std::move(parameters), solvers.ledger)
      , norm(make_error_norm(time, system))
      , control(make_step_control(time, error_exponent(facts_with(method.entry, node(method.entry.schema, method.facts.parameters)))))
      , integrator(
            make_integrator(method.entry, node(method.entry.schema, method.facts.parameters),
                            {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger, StartVelocity::consistent, norm.get()}))
      , state(system.initial_state(0))
    {}

    void run(const std::vector<Observer *> &observers = {})
    {
      run_loop(system, *integrator, *control, loop_settings(time), state, observers, solvers.ledger);
    }

    std::uint64_t steps() const { return solvers.ledger.counted("accepted steps"); }
    std::uint64_t refused() const { return solvers.ledger.counted("rejected steps"); }

    Solvers                      solvers;
    scene::Node                  time;
    OscillatorSystem             system;
    std::unique_ptr<ErrorNorm>   norm;
    std::unique_ptr<StepControl> control;
    std::unique_ptr<Integrator>  integrator;
    State                        state;
  };

  /// The same tolerance for all blocks that the method estimates.
  Overrides tolerance(const Verified &method, const double value)
  {
    Overrides  settings;
    const auto set = [&](const std::string &block) {
      std::ostringstream relative, absolute;
      relative << "control/" << block << "/relative tolerance=0";
      absolute << "control/" << block << "/absolute tolerance=" << value;
      settings.insert(settings.end(), {relative.str(), absolute.str()});
    };
    set("displacement");
    if (method.entry.facts.estimates_velocity)
      set("velocity");
    return settings;
  }

  std::vector<double> memory(const Integrator &integrator)
  {
    Archive archive;
    integrator.save(archive);
    std::vector<double> all;
    for (const auto *tables : {&archive.all_numbers(), &archive.all_vectors()})
      for (const auto &[name, numbers] : *tables)
        all.insert(all.end(), numbers.begin(), numbers.end());
    return all;
  }

  /// Root mean square error of u over the ends of steps, and the sizes of the steps.
  struct Watch : Observer
  {
    void accepted(const State &state, const StepRecord &record) override
    {
      sizes.push_back(record.dt);
      times.push_back(record.t);
      EXPECT_LE(record.report.error_estimate.value(), 1);
      if (exact)
        sum += std::pow(state.u(0) - exact(state.t).u, 2);
    }
    double rms() const { return std::sqrt(sum / sizes.size()); }

    std::function<Motion(double)> exact;
    double                        sum = 0;
    std::vector<double>           sizes, times;
  };

  class ByError : public ::testing::TestWithParam<Verified>
  {
  };

  std::vector<Verified> controlled_cases()
  {
    std::vector<Verified> all = all_cases();
    all.erase(std::remove_if(all.begin(), all.end(), [](const Verified &method) { return !method.facts.controls_error; }), all.end());
    return all;
  }
} // namespace

TEST_P(ByError, estimatesTheErrorOfAStep)
{
  // u'' + u = 0: the flow is a rotation, and the error of a step is its end against the flow from its beginning
  const Verified    &method = GetParam();
  const unsigned int k      = error_exponent(facts_with(method.entry, node(method.entry.schema, method.facts.parameters)));
  if (!method.facts.estimate_is_asymptotic)
    GTEST_SKIP() << "its estimate sees a part of the error";
  for (const bool velocity : {false, true})
    {
      if (velocity && !method.entry.facts.estimates_velocity)
        continue;
      Overrides settings = {"control/displacement/relative tolerance=0", "control/solver fraction=1e-12"};
      settings.push_back(velocity ? "control/displacement/absolute tolerance=1e30" : "control/displacement/absolute tolerance=1e3");
      if (velocity)
        settings.insert(settings.end(), {"control/velocity/relative tolerance=0", "control/velocity/absolute tolerance=1e3"});
      Adaptive     run(method, {}, 1, settings);
      const double h = 0.01;
      run.integrator->start(run.state);
      double estimate = 0;
      State  before;
      for (unsigned int i = 0; i < 60; ++i)
        {
          before                  = run.state;
          const StepReport report = run.integrator->step(h, run.state);
          ASSERT_TRUE(report.accepted()) << report.reason;
          run.state.t = (i + 1) * h;
          estimate    = 1e3 * report.error_estimate.value();
        }
      const double u = before.u(0), v = before.v(0), end_u = std::cos(h) * u + std::sin(h) * v, end_v = std::cos(h) * v - std::sin(h) * u;
      double       expected = velocity ? std::abs(run.state.v(0) - end_v) : std::abs(run.state.u(0) - end_u);
      if (method.facts.estimate)
        {
          const double t = before.t + h / 2 + (velocity ? M_PI / 2 : 0);
          expected       = *method.facts.estimate * std::pow(h, k) * std::abs(std::cos(t + k * M_PI / 2));
        }
      EXPECT_NEAR(estimate / expected, 1, 0.05) << (velocity ? "velocity" : "displacement") << ", estimate " << estimate;
    }
}

TEST_P(ByError, worksInProportionToTheToleranceOverFourDecades)
{
  const Verified    &method = GetParam();
  const unsigned int k      = error_exponent(facts_with(method.entry, node(method.entry.schema, method.facts.parameters)));
  for (const Problem &problem : problems())
    {
      std::vector<double> steps, errors;
      for (const double tol : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
        {
          Adaptive run(method, problem.parameters, 20, tolerance(method, tol));
          Watch    watch;
          watch.exact = problem.exact;
          run.run({&watch});
          steps.push_back(run.steps() + run.refused());
          errors.push_back(watch.rms());
          EXPECT_LT(run.refused(), 3 + 0.4 * run.steps()) << problem.name << ", tolerance " << tol;
        }
      const double work = std::log10(steps.back() / steps[1]) / 3, error = std::log10(errors[2] / errors.back()) / 2;
      EXPECT_NEAR(work * k, 1, method.facts.work) << problem.name << ", steps " << ::testing::PrintToString(steps);
      EXPECT_GT(error * k / method.facts.order, 0.75) << problem.name << ", errors " << ::testing::PrintToString(errors);
      for (std::size_t i = 1; i < steps.size(); ++i)
        EXPECT_GT(steps[i], steps[i - 1]) << problem.name;
    }
}

TEST_P(ByError, leavesNoTraceOfARefusedStep)
{
  Adaptive run(GetParam(), driven_duffing(), 1, tolerance(GetParam(), 1e-6));
  run.integrator->start(run.state);
  for (unsigned int i = 0; i < 3; ++i)
    {
      const StepReport report = run.integrator->step(1e-4, run.state);
      ASSERT_TRUE(report.accepted()) << report.reason;
    }
  const std::vector<double> before = values(run.state), remembered = memory(*run.integrator);
  const StepReport          report = run.integrator->step(0.3, run.state);
  EXPECT_EQ(report.outcome, StepReport::Outcome::error_too_large);
  EXPECT_GT(report.error_estimate.value(), 1);
  EXPECT_NE(report.reason.find("times the tolerance"), std::string::npos);
  EXPECT_EQ(values(run.state), before);
  EXPECT_EQ(memory(*run.integrator), remembered);
}

TEST_P(ByError, goesOnFromASavedStateBitForBit)
{
  struct Save : Keeper
  {
    void accepted(const State &now, const std::size_t step) override
    {
      run->solvers.linear.forget();
      if (step == 12)
        {
          run->integrator->save(integrator);
          run->control->save(control);
          state = now;
        }
    }
    std::optional<std::string> reason_to_stop(const State &, std::size_t) override { return std::nullopt; }
    void                       ended(const State &, std::size_t) override {}
    Adaptive                  *run = nullptr;
    Archive                    integrator, control;
    State                      state;
  } save;
  const Overrides settings = tolerance(GetParam(), GetParam().facts.order < 4 ? 1e-4 : 1e-6);
  Adaptive        whole(GetParam(), driven_duffing(), 2, settings);
  save.run = &whole;
  run_loop(whole.system, *whole.integrator, *whole.control, loop_settings(whole.time), whole.state, {}, whole.solvers.ledger, &save);
  ASSERT_GT(whole.steps(), 14u);

  Adaptive resumed(GetParam(), driven_duffing(), 2, settings);
  resumed.state = save.state;
  resumed.integrator->load(save.integrator);
  resumed.control->load(save.control);
  resumed.run();
  EXPECT_EQ(values(resumed.state), values(whole.state));
  EXPECT_EQ(resumed.steps() + 12, whole.steps());
}

TEST_P(ByError, landsOnKinksAndOnTheEnd)
{
  OscillatorParameters parameters;
  parameters.damping = 1;
  parameters.support = std::make_shared<Ramp>(0.3, 2);
  Adaptive run(GetParam(), parameters, 1, tolerance(GetParam(), 1e-4));
  Watch    watch;
  run.run({&watch});
  EXPECT_EQ(std::count(watch.times.begin(), watch.times.end(), 0.3), 1);
  EXPECT_EQ(run.state.t, 1);
  EXPECT_EQ(run.solvers.ledger.counted("restarts at events"), 1u);
  EXPECT_LE(run.refused(), 12u) << "of " << run.steps();
}

INSTANTIATE_TEST_SUITE_P(registry, ByError, ::testing::ValuesIn(controlled_cases()),
                         [](const auto &info) { return info.param.facts.label; });

TEST(ErrorControlled, refusesWhatCannotBeEstimated)
{
  for (const Verified &method : all_cases())
    {
      if (!method.facts.controls_error)
        {
          EXPECT_THROW(Adaptive(method, {}, 1, {}), InputError) << method.facts.label;
        }
      if (!method.entry.facts.estimates_velocity)
        {
          EXPECT_THROW(Adaptive(method, {}, 1, {"control/velocity/relative tolerance=0.1"}), InputError) << method.facts.label;
        }
    }
  EXPECT_THROW(Adaptive({integrator_entry("static"), {}}, {}, 1, {}), InputError);
}

TEST(ErrorControlled, takesLongStepsThroughHeldPhases)
{
  // heavily damped, pulled within 0.2 s and then held: what moves decays like e^(-t/4) and slower components are absent
  for (const Verified &method : controlled_cases())
    {
      OscillatorParameters parameters;
      parameters.displacement = 0;
      parameters.damping      = 20;
      parameters.stiffness    = 100;
      parameters.force = std::make_shared<SmoothDrive>([](double t) { return t < 0.2 ? 100 * std::pow(std::sin(M_PI * t / 0.4), 2) : 100; },
                                                       [](double) { return 0.; }, [](double) { return 0.; });
      if (!method.facts.long_steps)
        continue;
      Adaptive run(method, parameters, 40, tolerance(method, 1e-4));
      Watch    watch;
      run.run({&watch});
      EXPECT_GT(*std::max_element(watch.sizes.begin(), watch.sizes.end()), 3.) << method.facts.label;
      EXPECT_NEAR(run.state.u(0), 1, 1e-3) << method.facts.label;
    }
}

TEST(ErrorControlled, endsTheRunAtItsMinimumStep)
{
  OscillatorParameters parameters;
  parameters.force = std::make_shared<SmoothDrive>([](double t) { return t < 0.5 ? 0. : 1e6; }, [](double) { return 0.; },
                                                   [](double) { return 0.; }); // a jump that no kink tells of
  const Verified method{integrator_entry("sdirk2"), {}};
  Overrides      settings = tolerance(method, 1e-8);
  settings.insert(settings.end(), {"control/minimum step=1e-4", "step=0.01"});
  Adaptive run(method, parameters, 1, settings);
  try
    {
      run.run();
      FAIL() << "must end";
    }
  catch (const SolveError &error)
    {
      const std::string text = error.what();
      for (const char *part : {"times the tolerance", "minimum step", "larger tolerances"})
        EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
    }
  EXPECT_GT(run.state.t, 0.45);
  EXPECT_LE(run.state.t, 0.5);
}
