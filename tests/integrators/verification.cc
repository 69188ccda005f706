// What every dynamic method of integrators/list.def must show, through the same code that runs a scene.

#include "exact.h"
#include "experiment.h"

#include <myolines/base/error.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  class Dynamic : public ::testing::TestWithParam<IntegratorEntry>
  {
  protected:
    const ClosedForm &closed_form() const
    {
      const auto found = closed_forms().find(GetParam().facts.name);
      if (found == closed_forms().end())
        throw std::runtime_error("\"" + GetParam().facts.name
                                 + "\" is registered, but tests/integrators/exact.h has no closed form to verify it");
      return found->second;
    }
  };

  constexpr double end = 1.7;

  Motion error(const IntegratorEntry &entry, const Problem &problem, const BoundaryRates rates, const double step)
  {
    Experiment experiment(entry, problem.parameters, rates);
    experiment.run(end, step);
    EXPECT_EQ(experiment.state.t, end);
    const Motion exact = problem.exact(end);
    return {experiment.state.u(0) - exact.u, experiment.state.v(0) - exact.v};
  }

  /// One step of size 1 from each unit vector of (u, v, a), for m u'' + c u' + k u = 0.
  dealii::LAPACKFullMatrix<double> step_matrix(const IntegratorEntry &entry, const double damping, const double stiffness)
  {
    dealii::LAPACKFullMatrix<double> matrix(3, 3);
    OscillatorParameters             parameters;
    parameters.damping   = damping;
    parameters.stiffness = stiffness;
    for (unsigned int column = 0; column < 3; ++column)
      {
        Experiment experiment(entry, parameters);
        State     &s = experiment.state;
        s.u(0)       = column == 0;
        s.v(0)       = column == 1;
        experiment.integrator->start(s);
        s.a(0) = column == 2;
        EXPECT_TRUE(experiment.integrator->step(1, s).accepted());
        matrix(0, column) = s.u(0);
        matrix(1, column) = s.v(0);
        matrix(2, column) = s.a(0);
      }
    return matrix;
  }

  /// The eigenvalue of largest modulus, with non-negative imaginary part.
  std::complex<double> principal_eigenvalue(dealii::LAPACKFullMatrix<double> matrix)
  {
    matrix.compute_eigenvalues();
    std::complex<double> largest = 0;
    for (unsigned int i = 0; i < 3; ++i)
      if (std::abs(matrix.eigenvalue(i)) > std::abs(largest))
        largest = matrix.eigenvalue(i);
    return {largest.real(), std::abs(largest.imag())};
  }
} // namespace

TEST_P(Dynamic, hasItsOrderInDisplacementAndVelocity)
{
  const double order = GetParam().facts.order;
  const double steps = order == 1 ? 1600 : order == 2 ? 100 : 40;
  for (const Problem &problem : problems())
    for (const BoundaryRates rates : {BoundaryRates::exact, BoundaryRates::scheme})
      {
        if (rates == BoundaryRates::scheme && !problem.parameters.support)
          continue;
        const Motion coarse = error(GetParam(), problem, rates, end / steps);
        const Motion fine   = error(GetParam(), problem, rates, end / (2 * steps));
        EXPECT_NEAR(std::log2(coarse.u / fine.u), order, 0.05) << "displacement, " << problem.name << ", error " << fine.u;
        EXPECT_NEAR(std::log2(coarse.v / fine.v), order, 0.05) << "velocity, " << problem.name << ", error " << fine.v;
      }
}

TEST_P(Dynamic, hasItsErrorConstant)
{
  const double step   = end / 8000;
  const Motion theory = closed_form().error(end);
  const Motion actual = error(GetParam(), problems().front(), BoundaryRates::exact, step);
  const double scale  = std::pow(step, GetParam().facts.order);
  EXPECT_NEAR(actual.u / scale / theory.u, 1, 0.01);
  EXPECT_NEAR(actual.v / scale / theory.v, 1, 0.01);
}

TEST_P(Dynamic, amplifiesAsTheorySays)
{
  for (const double damping_ratio : {0., 0.1})
    for (double frequency = 1e-2; frequency < 1.01e4; frequency *= std::sqrt(10.))
      {
        const std::complex<double> z(-damping_ratio * frequency, std::sqrt(1 - damping_ratio * damping_ratio) * frequency);
        const std::complex<double> theory = closed_form().amplification(z);
        const std::complex<double> actual
            = principal_eigenvalue(step_matrix(GetParam(), 2 * damping_ratio * frequency, frequency * frequency));
        const auto period_error  = [&](std::complex<double> q) { return z.imag() / std::arg(q) - 1; };
        const auto damping_shown = [](std::complex<double> q) { return -std::log(std::abs(q)) / std::arg(q); };
        EXPECT_NEAR(std::abs(actual) / std::abs(theory), 1, 1e-9) << "spectral radius at omega dt = " << frequency;
        EXPECT_NEAR(period_error(actual), period_error(theory), 1e-8 * (1 + frequency)) << "period at omega dt = " << frequency;
        EXPECT_NEAR(damping_shown(actual), damping_shown(theory), 1e-8 * (1 + damping_shown(theory)))
            << "damping at omega dt = " << frequency;
      }
}

TEST_P(Dynamic, followsAConstantAccelerationExactlyIfOfSecondOrder)
{
  if (GetParam().facts.order < 2)
    GTEST_SKIP() << "a first-order method";
  OscillatorParameters parameters;
  parameters.stiffness    = 0;
  parameters.displacement = 0;
  parameters.force        = std::make_shared<SmoothDrive>([](double) { return 3.; }, [](double) { return 0.; }, [](double) { return 0.; });
  Experiment experiment(GetParam(), parameters);
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
      Experiment experiment(GetParam(), parameters, rates);
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
  parameters.support = std::make_shared<Ramp>(0.3, 2);
  Experiment experiment(GetParam(), parameters);
  experiment.run(0.3, 0.1, {&observer});
  EXPECT_EQ(experiment.state.v(1), 0) << "a run that ends on a kink reports the velocity before it";

  Experiment longer(GetParam(), parameters);
  longer.run(0.5, 0.125, {&observer});
  EXPECT_EQ(observer.velocity, 0);
  EXPECT_EQ(longer.state.v(1), 2);
  EXPECT_EQ(longer.solvers.ledger.counted("restarts at events"), 1u);
}

TEST_P(Dynamic, assemblesTheJacobianOfALinearSystemOnce)
{
  Experiment experiment(GetParam(), {});
  experiment.run(1, 0.125); // sizes that are exact in floating point: one set of weights
  EXPECT_EQ(experiment.solvers.ledger.counted("linearisations"), 1u);
  EXPECT_EQ(experiment.solvers.ledger.counted("jacobian assemblies"), 1u);
  EXPECT_EQ(experiment.solvers.ledger.counted("preconditioner set-ups"), 1u);
}

INSTANTIATE_TEST_SUITE_P(registry, Dynamic, ::testing::ValuesIn(registered(true)), [](const auto &info) {
  std::string name = info.param.facts.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
});
