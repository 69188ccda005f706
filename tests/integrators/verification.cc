// SPDX-License-Identifier: LGPL-2.1-or-later
// What every dynamic method of the list must show (cases.h), through the same code that runs a scene.

#include "exact.h"
#include "measured.h"

#include <myolines/base/error.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  class Dynamic : public ::testing::TestWithParam<Verified>
  {
  protected:
    Experiment experiment(OscillatorParameters parameters, const BoundaryRates rates = BoundaryRates::exact) const
    {
      return {GetParam().entry, std::move(parameters), rates, GetParam().facts.parameters};
    }

    /// Root mean squares of the errors after every @p every steps: at single instants the leading term may be near a zero.
    Motion rms_error(const Problem &problem, const BoundaryRates rates, const double step, const unsigned int every) const
    {
      struct Errors : Observer
      {
        void accepted(const State &state, const StepRecord &record) override
        {
          if (record.number % every != 0)
            return;
          const Motion now = exact(state.t);
          sum.u += std::pow(state.u(0) - now.u, 2);
          sum.v += std::pow(state.v(0) - now.v, 2);
          ++n;
        }
        std::function<Motion(double)> exact;
        unsigned int                  every = 1, n = 0;
        Motion                        sum{0, 0};
      } errors;
      errors.exact   = problem.exact;
      errors.every   = every;
      Experiment run = experiment(problem.parameters, rates);
      run.run(end, step, {&errors});
      EXPECT_EQ(run.state.t, end);
      return {std::sqrt(errors.sum.u / errors.n), std::sqrt(errors.sum.v / errors.n)};
    }

    static constexpr double end = 1.7;
  };
} // namespace

TEST_P(Dynamic, hasItsOrderInDisplacementAndVelocity)
{
  const Case &facts = GetParam().facts;
  for (const Problem &problem : problems())
    for (const BoundaryRates rates : {BoundaryRates::exact, BoundaryRates::scheme})
      {
        if (rates == BoundaryRates::scheme && !(problem.parameters.support && facts.scheme_rates))
          continue;
        Motion     order{1. * facts.order, 1. * facts.order};
        const auto other = facts.other_orders.find(problem.name);
        if (other != facts.other_orders.end())
          order = other->second;
        const Motion coarse = rms_error(problem, rates, end / facts.steps, 1);
        const Motion fine   = rms_error(problem, rates, end / (2 * facts.steps), 2);
        EXPECT_NEAR(std::log2(coarse.u / fine.u), order.u, 0.05) << "displacement, " << problem.name << ", error " << fine.u;
        EXPECT_NEAR(std::log2(coarse.v / fine.v), order.v, 0.05) << "velocity, " << problem.name << ", error " << fine.v;
      }
}

TEST_P(Dynamic, hasItsErrorConstant)
{
  const Case   &facts   = GetParam().facts;
  const double  step    = end / (facts.order == 1 ? 8000 : facts.order == 2 ? 2000 : facts.steps_of_constant);
  const Problem problem = problems().front();
  Experiment    run     = experiment(problem.parameters);
  run.run(end, step);
  const Motion exact = problem.exact(end), theory = facts.error(end);
  const double scale = std::pow(step, facts.order), size = std::hypot(theory.u, theory.v);
  EXPECT_NEAR((run.state.u(0) - exact.u) / scale, theory.u, 0.01 * size);
  EXPECT_NEAR((run.state.v(0) - exact.v) / scale, theory.v, 0.01 * size);
}

TEST_P(Dynamic, amplifiesAsTheorySays)
{
  const Case &facts = GetParam().facts;
  for (const double xi : {0., 0.1})
    for (double w = 1e-2; w < 1.01 * facts.highest_frequency; w *= std::sqrt(10.))
      {
        const Polynomial theory = facts.polynomial(w, xi);
        Polynomial       actual = characteristic_polynomial(transition_matrix(GetParam(), w, xi));
        double           size   = 1;
        for (const double coefficient : theory)
          size = std::max(size, std::abs(coefficient));
        for (std::size_t i = 0; i < actual.size(); ++i)
          EXPECT_NEAR(actual[i], i < theory.size() ? theory[i] : 0., 1e-9 * size) << "coefficient " << i << " at omega dt = " << w;

        // the curves that are drawn; roots that meet, as at infinity, have a third of the digits of the coefficients
        actual.resize(theory.size());
        const std::complex<double> q = principal_root(actual), q0 = principal_root(theory);
        EXPECT_NEAR(std::abs(q) / std::abs(q0), 1, 1e-4) << "spectral radius at omega dt = " << w;
        if (w > 1)
          continue;
        const double frequency     = std::sqrt(1 - xi * xi) * w;
        const auto   period_error  = [&](std::complex<double> x) { return frequency / std::arg(x) - 1; };
        const auto   damping_shown = [](std::complex<double> x) { return -std::log(std::abs(x)) / std::arg(x); };
        EXPECT_NEAR(period_error(q), period_error(q0), 1e-7) << "period at omega dt = " << w;
        EXPECT_NEAR(damping_shown(q), damping_shown(q0), 1e-7) << "damping at omega dt = " << w;
      }
}

TEST_P(Dynamic, followsAConstantAccelerationExactlyIfOfSecondOrder)
{
  if (GetParam().facts.order < 2 || !GetParam().facts.exact_start)
    GTEST_SKIP() << "a first-order method, or one that begins with a first-order step";
  OscillatorParameters parameters;
  parameters.stiffness    = 0;
  parameters.displacement = 0;
  parameters.force        = std::make_shared<SmoothDrive>([](double) { return 3.; }, [](double) { return 0.; }, [](double) { return 0.; });
  Experiment experiment   = this->experiment(parameters);
  experiment.run(1, 0.125);
  EXPECT_NEAR(experiment.state.u(0), 1.5, 1e-13);
  EXPECT_NEAR(experiment.state.v(0), 3, 1e-13);
}

TEST_P(Dynamic, movesBoundariesByTheChosenRates)
{
  OscillatorParameters parameters;
  parameters.support = sine(1, 2);
  for (const BoundaryRates rates : {BoundaryRates::exact, BoundaryRates::scheme})
    {
      if (rates == BoundaryRates::scheme && !GetParam().facts.scheme_rates)
        {
          EXPECT_THROW(experiment(parameters, rates), InputError);
          continue;
        }
      Experiment experiment = this->experiment(parameters, rates);
      experiment.run(0.25, 0.25);
      EXPECT_EQ(experiment.state.u(1), parameters.support->value(0.25));
      const double exact = parameters.support->first_derivative(0.25);
      if (rates == BoundaryRates::exact)
        {
          EXPECT_EQ(experiment.state.v(1), exact);
          EXPECT_EQ(experiment.state.a(1), parameters.support->second_derivative(0.25));
        }
      else
        {
          EXPECT_GT(std::abs(experiment.state.v(1) - exact), 1e-3) << "a difference formula, not the derivative";
          EXPECT_NEAR(experiment.state.v(1), exact, 0.5);
        }
    }
}

TEST_P(Dynamic, endsOnTheLeftOfAKinkAndGoesOnFromTheRight)
{
  struct AtKink : Observer
  {
    void accepted(const State &state, const StepRecord &record) override
    {
      if (record.t == 0.3)
        velocity = state.v(1);
    }
    double velocity = -1;
  } observer;

  OscillatorParameters parameters;
  parameters.support    = std::make_shared<Ramp>(0.3, 2);
  Experiment experiment = this->experiment(parameters);
  experiment.run(0.3, 0.1, {&observer});
  EXPECT_EQ(experiment.state.v(1), 0) << "a run that ends on a kink reports the velocity before it";

  Experiment longer = this->experiment(parameters);
  longer.run(0.5, 0.125, {&observer});
  EXPECT_EQ(observer.velocity, 0);
  EXPECT_EQ(longer.state.v(1), 2);
  EXPECT_EQ(longer.solvers.ledger.counted("restarts at events"), 1u);
}

TEST_P(Dynamic, linearisesALinearSystemOnceAndAssemblesAMatrixForEachWeight)
{
  const double       step       = 0.125; // sizes that are exact in floating point: one set of weights
  const Case        &facts      = GetParam().facts;
  const unsigned int starting   = facts.starting_steps;
  Experiment         experiment = this->experiment({});
  experiment.run((starting + 1) * step, step);
  const WorkLedger before = experiment.solvers.ledger;
  experiment.run((starting + 7) * step, step);
  const auto since = [&](const char *what) { return experiment.solvers.ledger.counted(what) - before.counted(what); };
  EXPECT_EQ(since("linearisations"), 0u);
  EXPECT_EQ(before.counted("linearisations"), 1u);
  for (const char *what : {"jacobian assemblies", "preconditioner set-ups"})
    EXPECT_LE(since(what), facts.matrices == 1 ? 0u : 6 * facts.matrices) << what;
  if (facts.matrices == 1)
    {
      EXPECT_LE(before.counted("jacobian assemblies"), 2u) << "of the mass at the start or of a first step, and of a step";
    }
}

INSTANTIATE_TEST_SUITE_P(registry, Dynamic, ::testing::ValuesIn(all_cases()), [](const auto &info) { return info.param.facts.label; });

TEST(Cases, coverEveryDynamicMethodAndEveryPreset)
{
  for (const MethodCases &method : method_cases())
    {
      const IntegratorEntry &entry = method.entry;
      EXPECT_EQ(entry.facts.dynamic && !entry.make_self_paced, !method.cases.empty()) << entry.facts.name;
      if (!entry.schema.variant())
        continue;
      for (const auto &[name, schema] : entry.schema.variant()->alternatives)
        {
          const std::string wanted = entry.schema.variant()->selector + "=" + name;
          EXPECT_TRUE(std::any_of(method.cases.begin(), method.cases.end(), [&](const Case &c) {
            return std::count(c.parameters.begin(), c.parameters.end(), wanted) == 1;
          })) << wanted;
        }
    }
}
