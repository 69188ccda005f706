// SPDX-License-Identifier: LGPL-2.1-or-later
// The promises of the class Integrator that hold for every method of the list whose steps are given, dynamic or not.

#include "experiment.h"

#include <myolines/base/error.h>

#include <gtest/gtest.h>

#include <set>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  class Every : public ::testing::TestWithParam<IntegratorEntry>
  {
  };
} // namespace

TEST_P(Every, failedStepLeavesTheStateAsItWas)
{
  OscillatorParameters parameters = driven_duffing();
  parameters.force = std::make_shared<SmoothDrive>([](double t) { return t < 0.01 ? 1. : std::numeric_limits<double>::infinity(); },
                                                   [](double) { return 0.; }, [](double) { return 0.; });
  Experiment experiment(GetParam(), parameters);
  experiment.integrator->start(experiment.state);
  const std::vector<double> before = values(experiment.state);
  const StepReport          report = experiment.integrator->step(0.1, experiment.state);
  EXPECT_EQ(report.outcome, StepReport::Outcome::inadmissible);
  EXPECT_FALSE(report.reason.empty());
  EXPECT_EQ(values(experiment.state), before);
}

TEST_P(Every, aStepThatDoesNotConvergeIsRefusedOrTakenWithoutIteration)
{
  // A stiff cubic spring, one Newton iteration: only a linearly implicit step can be taken.
  OscillatorParameters parameters = driven_duffing();
  parameters.cubic_stiffness      = 1e4;
  Experiment experiment(GetParam(), parameters, BoundaryRates::exact, {}, {"maximum iterations=1", "relative tolerance=1e-12"});
  experiment.integrator->start(experiment.state);
  const std::vector<double> before = values(experiment.state);
  const StepReport          report = experiment.integrator->step(0.1, experiment.state);
  EXPECT_EQ(report.accepted(), GetParam().facts.solves == MethodFacts::Solves::linear_systems);
  if (report.accepted())
    return;
  EXPECT_FALSE(report.reason.empty());
  EXPECT_EQ(values(experiment.state), before);
}

TEST_P(Every, goesOnFromASavedStateBitForBit)
{
  if (GetParam().facts.restart != MethodFacts::Restart::exact)
    GTEST_SKIP() << "restarts by starting anew";
  Experiment whole(GetParam(), driven_duffing());
  whole.run(0.5, 0.03125);
  Archive archive;
  whole.integrator->save(archive);
  const State middle = whole.state;
  whole.solvers.linear.forget();
  whole.run(1, 0.03125);

  Experiment resumed(GetParam(), driven_duffing());
  resumed.state = middle;
  resumed.integrator->load(archive);
  resumed.run(1, 0.03125);
  EXPECT_EQ(values(resumed.state), values(whole.state));
  EXPECT_EQ(resumed.state.t, 1);
}

TEST_P(Every, countsItsWork)
{
  Experiment experiment(GetParam(), driven_duffing());
  experiment.integrator->start(experiment.state);
  const WorkLedger &ledger = experiment.solvers.ledger;
  const WorkLedger  before = ledger;
  const StepReport  report = experiment.integrator->step(0.1, experiment.state);
  ASSERT_TRUE(report.accepted()) << report.reason;
  const auto counted = [&](const std::string &what) { return ledger.counted(what) - before.counted(what); };
  EXPECT_GE(report.newton_iterations, 1u);
  EXPECT_EQ(report.newton_iterations, counted("newton iterations"));
  EXPECT_EQ(report.linear_iterations, counted("linear iterations"));
  EXPECT_GE(report.residual_evaluations, counted("residual evaluations"));
  ASSERT_EQ(report.final_residual.has_value(), GetParam().facts.solves == MethodFacts::Solves::nonlinear_equations);
  if (report.final_residual)
    EXPECT_LT(*report.final_residual, 1e-12 * report.initial_residual.value());
}

TEST_P(Every, refusesParametersItDoesNotKnow) { EXPECT_THROW(node(GetParam().schema, {"no such parameter=1"}), InputError); }

INSTANTIATE_TEST_SUITE_P(registry, Every, ::testing::ValuesIn(native_methods()), [](const auto &info) {
  std::string name = info.param.facts.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
});

TEST(Registry, statesTheFactsOfEveryMethod)
{
  std::set<std::string> names;
  for (const IntegratorEntry &entry : integrator_registry())
    {
      EXPECT_TRUE(names.insert(entry.facts.name).second) << entry.facts.name << " twice";
      EXPECT_FALSE(entry.facts.summary.empty());
      EXPECT_FALSE(entry.facts.reference.empty());
      EXPECT_FALSE(entry.facts.stability.empty());
      EXPECT_EQ(entry.facts.order > 0, entry.facts.dynamic);
      EXPECT_EQ(integrator_entry(entry.facts.name).facts.summary, entry.facts.summary);
    }
  EXPECT_THROW(integrator_entry("no such method"), std::out_of_range);
}

TEST(Static, findsTheEquilibriumOfTheCubicSpring)
{
  // u^3 + p u + q = 0 has the real root of Cardano's formula for p > 0.
  OscillatorParameters parameters;
  parameters.mass            = 5;
  parameters.damping         = 4;
  parameters.stiffness       = 2;
  parameters.cubic_stiffness = 3;
  parameters.force           = sine(10, 1);
  Experiment experiment(integrator_entry("static"), parameters);
  for (const double t : {0.5, 1., 1.5})
    {
      experiment.run(t, 0.5);
      const double p = 2. / 3, q = -10 * std::sin(t) / 3;
      const double root     = std::sqrt(q * q / 4 + p * p * p / 27);
      const double expected = std::cbrt(-q / 2 + root) + std::cbrt(-q / 2 - root);
      EXPECT_NEAR(experiment.state.u(0), expected, 1e-13);
      EXPECT_EQ(experiment.state.v(0), 0);
      EXPECT_EQ(experiment.state.a(0), 0);
    }
}

TEST(Static, followsASupportWithoutRates)
{
  OscillatorParameters parameters;
  parameters.damping = 4;
  parameters.support = sine(1, 2);
  Experiment experiment(integrator_entry("static"), parameters);
  experiment.run(0.7, 0.1);
  EXPECT_EQ(experiment.state.u(1), std::sin(2 * 0.7));
  EXPECT_NEAR(experiment.state.u(0), std::sin(2 * 0.7), 1e-14);
  EXPECT_EQ(experiment.state.v(1), 0);
}
