// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/drives.h"

#include <myolines/oscillator/oscillator_system.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  OscillatorParameters full()
  {
    OscillatorParameters parameters;
    parameters.mass            = 0.7;
    parameters.damping         = 0.3;
    parameters.stiffness       = 2;
    parameters.cubic_stiffness = 5;
    parameters.force           = sine(1.1, 2);
    parameters.support         = sine(0.4, 3);
    return parameters;
  }

  State random_state(const OscillatorSystem &system, std::mt19937 &generator)
  {
    std::uniform_real_distribution<double> uniform(-1, 1);
    State                                  state = system.initial_state(0);
    for (Vector *x : {&state.u, &state.v, &state.a})
      for (double &entry : *x)
        entry = uniform(generator);
    return state;
  }

  Vector residual(const OscillatorSystem &system, const State &state)
  {
    Vector r(state.u);
    EXPECT_TRUE(system.residual({state.t, Side::left, state.u, state.v, state.a}, r).admissible);
    return r;
  }
} // namespace

TEST(Oscillator, residualIsTheEquationOfMotion)
{
  WorkLedger             ledger;
  const OscillatorSystem system(full(), ledger);
  std::mt19937           generator(1);
  State                  s = random_state(system, generator);
  s.t                      = 0.37;
  const Vector r           = residual(system, s);
  const double stretch     = s.u(0) - s.u(1);
  const double spring      = 0.3 * (s.v(0) - s.v(1)) + 2 * stretch + 5 * std::pow(stretch, 3);
  EXPECT_NEAR(r(0), 0.7 * s.a(0) + spring - 1.1 * std::sin(2 * 0.37), 1e-14);
  EXPECT_NEAR(r(1), -spring, 1e-14) << "the force that the support exerts";
  EXPECT_EQ(ledger.counted("residual evaluations"), 1u);
}

TEST(Oscillator, linearisationPassesTheTaylorTestInEachOfKCM)
{
  WorkLedger             ledger;
  const OscillatorSystem system(full(), ledger);
  const auto             linearisation = system.make_linearisation();
  std::mt19937           generator(2);
  const State            s = random_state(system, generator);
  system.linearise({s.t, Side::left, s.u, s.v, s.a}, *linearisation);
  const Vector r0 = residual(system, s);

  for (const WeightsByOrder &w : {stage_weights(1, 0, 0), stage_weights(0, 1, 0), stage_weights(0, 0, 1), stage_weights(1, 3, 7)})
    {
      const Vector        direction = random_state(system, generator).u;
      std::vector<double> remainders;
      for (double h = 1e-1; h > 1e-6; h /= 10)
        {
          State shifted = s;
          shifted.u.add(h * w[2].u, direction);
          shifted.v.add(h * w[2].v, direction);
          shifted.a.add(h * w[2].a, direction);
          Vector product(direction), remainder = residual(system, shifted);
          linearisation->apply(w, direction, product);
          remainder -= r0;
          remainder.add(-h, product);
          remainders.push_back(remainder.l2_norm());
        }
      for (std::size_t k = 0; k + 1 < 4; ++k)
        if (w[2].u == 0)
          {
            EXPECT_LT(remainders[k], 1e-14) << "linear in v and a";
          }
        else
          {
            EXPECT_NEAR(std::log10(remainders[k] / remainders[k + 1]), 2, 0.12);
          }
    }
}

TEST(Oscillator, assembledMatrixIsTheFreePartOfTheOperator)
{
  WorkLedger             ledger;
  const OscillatorSystem system(full(), ledger);
  const auto             linearisation = system.make_linearisation();
  std::mt19937           generator(3);
  const State            s = random_state(system, generator);
  system.linearise({s.t, Side::left, s.u, s.v, s.a}, *linearisation);
  const WeightsByOrder w = stage_weights(1, 10, 100);
  Vector               unit(s.u), column(s.u);
  unit    = 0;
  unit(0) = 1;
  linearisation->apply(w, unit, column);
  const SparseMatrix &matrix = linearisation->sparse(w);
  EXPECT_DOUBLE_EQ(matrix.el(0, 0), column(0));
  EXPECT_EQ(matrix.el(0, 1), 0);
  EXPECT_EQ(matrix.el(1, 0), 0);
  EXPECT_NE(matrix.el(1, 1), 0);
  linearisation->sparse(w);
  EXPECT_EQ(ledger.counted("jacobian assemblies"), 1u) << "the same weights need no second assembly";
}

TEST(Oscillator, supportIsPrescribedWithSides)
{
  OscillatorParameters parameters;
  parameters.support = std::make_shared<Ramp>(0.5, 2);
  WorkLedger             ledger;
  const OscillatorSystem system(parameters, ledger);
  State                  state = system.initial_state(0);
  EXPECT_EQ(state.u(0), 1);
  system.prescribed(0.5, Side::left, state);
  EXPECT_EQ(state.v(1), 0);
  system.prescribed(0.5, Side::right, state);
  EXPECT_EQ(state.v(1), 2);
  EXPECT_EQ(state.u(0), 1) << "free unknowns stay";
  EXPECT_EQ(system.events(0, 1), std::vector<double>{0.5});
  EXPECT_TRUE(system.events(0.5, 1).empty());
  EXPECT_TRUE(system.constraints().is_constrained(1));
}

TEST(Oscillator, saysSoWhereItIsInadmissible)
{
  WorkLedger             ledger;
  const OscillatorSystem system(full(), ledger);
  State                  state = system.initial_state(0);
  state.u(0)                   = std::numeric_limits<double>::infinity();
  Vector           r(state.u);
  const Evaluation evaluation = system.residual({0, Side::left, state.u, state.v, state.a}, r);
  EXPECT_FALSE(evaluation.admissible);
  EXPECT_FALSE(evaluation.reason.empty());
  EXPECT_TRUE(std::isnan(r(0)));
}

TEST(Oscillator, isReadFromAScene)
{
  const scene::Node          node = scene::parse_scene("<ParameterList name=\"scene\"></ParameterList>", oscillator_schema(), "test", ".",
                                                       {"mass=3", "damping=0.1", "stiffness=4", "cubic stiffness=5", "displacement=0.5",
                                                        "velocity=-1", "force/type=sine", "force/amplitude=1", "force/frequency=2"});
  const OscillatorParameters parameters = read_oscillator(node);
  EXPECT_EQ(parameters.mass, 3);
  EXPECT_EQ(parameters.damping, 0.1);
  EXPECT_EQ(parameters.stiffness, 4);
  EXPECT_EQ(parameters.cubic_stiffness, 5);
  EXPECT_EQ(parameters.displacement, 0.5);
  EXPECT_EQ(parameters.velocity, -1);
  EXPECT_TRUE(parameters.force);
  EXPECT_FALSE(parameters.support);
}

/// dE/dt = rates + r v of the mass, at any state: the identity that the balance of energy rests on.
TEST(Oscillator, energyAndItsRatesBelongToTheResidual)
{
  WorkLedger             ledger;
  const OscillatorSystem system(full(), ledger);
  std::mt19937           generator(5);
  State                  s = random_state(system, generator);
  s.t                      = 0.6;
  const double h           = 1e-5;
  const auto   energy      = [&](const double part) {
    State moved = s;
    for (unsigned int i = 0; i < 2; ++i)
      {
        moved.u(i) += part * s.v(i);
        moved.v(i) += part * s.a(i);
      }
    return system.energetics(moved, Side::left).energy;
  };
  const EnergyRates rates = system.energetics(s, Side::left).rates;
  EXPECT_NEAR((energy(h) - energy(-h)) / (2 * h), rates.active - rates.dissipation + rates.external + residual(system, s)(0) * s.v(0),
              1e-8);
  EXPECT_NEAR(rates.dissipation, 0.3 * std::pow(s.v(0) - s.v(1), 2), 1e-14);
  EXPECT_TRUE(system.capabilities().energy);
}
