// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/drives.h"
#include "rod.h"

#include <myolines/base/error.h>

#include <gtest/gtest.h>

#include <random>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  Rod1dParameters parameters(const unsigned int degree, const bool linear)
  {
    Rod1dParameters p;
    p.degree     = degree;
    p.n_elements = 5;
    p.material   = linear ? RodMaterial::linear_elastic(1e6, 0.3) : RodMaterial::neo_hookean_corrected(1e6, 0.3);
    p.strain     = sine(0.1, 2);
    return p;
  }

  State random_state(const Rod1dSystem &system, const double amplitude)
  {
    std::mt19937                           generator(3);
    std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
    State                                  state = system.initial_state(0);
    for (Vector *x : {&state.u, &state.v, &state.a})
      for (double &entry : *x)
        entry = uniform(generator);
    return state;
  }

  Vector residual(const Rod1dSystem &system, const State &s)
  {
    Vector r(s.u);
    EXPECT_TRUE(system.residual({s.t, Side::left, s.u, s.v, s.a}, r).admissible);
    return r;
  }
} // namespace

TEST(RodMaterial, vanishesAtRestAndHasItsTangent)
{
  for (const RodMaterial &m :
       {RodMaterial::linear_elastic(1e6, 0.3), RodMaterial::neo_hookean_thesis(1e6, 0.4), RodMaterial::neo_hookean_corrected(1e6, 0.4)})
    {
      EXPECT_EQ(m.stress(0), 0);
      for (const double e : {-0.3, 0.01, 0.4})
        EXPECT_NEAR(m.tangent(e), (m.stress(e + 1e-5) - m.stress(e - 1e-5)) / 2e-5, 1e-4 * m.tangent(e)) << e;
    }
  // thesis (4.7.2) as its numbers were made, and the Lame parameters of E = 3 kappa (1 - 2 nu) = 6e5 Pa
  const RodMaterial thesis = RodMaterial::neo_hookean_thesis(1e6, 0.4), corrected = RodMaterial::neo_hookean_corrected(1e6, 0.4);
  EXPECT_NEAR(thesis.lambda, 3.3333333333e6, 1e-3);
  EXPECT_NEAR(thesis.mu, 3.5714285714e5, 1e-4);
  EXPECT_NEAR(corrected.lambda, 8.5714285714e5, 1e-4);
  EXPECT_NEAR(corrected.mu, 2.1428571429e5, 1e-4);
}

TEST(Rod1d, linearisationPassesTheTaylorTest)
{
  for (const bool linear : {true, false})
    for (const unsigned int degree : {1u, 2u, 3u})
      {
        Solvers           solvers;
        const Rod1dSystem system(parameters(degree, linear), solvers.ledger);
        State             s = random_state(system, 1e-3), along = random_state(system, 1e-3);
        const auto        tangent = system.make_linearisation();
        system.linearise({0, Side::left, s.u, s.v, s.a}, *tangent);
        std::swap(along.u, along.a); // another direction than s
        Vector       ku(s.u), ma(s.u);
        const double h = 1e-4;
        tangent->apply(stage_weights(1, 0, 0), along.u, ku);
        tangent->apply({{{1, 0, 0}, {0, 0, 0}, {0, 0, 1}}}, along.a, ma);
        State plus = s, minus = s;
        plus.u.add(h, along.u);
        plus.a.add(h, along.a);
        minus.u.add(-h, along.u);
        minus.a.add(-h, along.a);
        Vector difference = residual(system, plus);
        difference -= residual(system, minus);
        difference *= 1 / (2 * h);
        ku += ma;
        const double size = ku.l2_norm();
        ku -= difference;
        EXPECT_LT(ku.l2_norm(), 1e-8 * size) << "degree " << degree << ", linear " << linear;
      }
}

TEST(Rod1d, aUniformStretchIsInEquilibriumWithItsReactions)
{
  for (const unsigned int degree : {1u, 2u, 3u})
    {
      Solvers           solvers;
      const Rod1dSystem system(parameters(degree, false), solvers.ledger);
      State             s = system.initial_state(0);
      for (unsigned int i = 0; i < s.u.size(); ++i)
        s.u(i) = 0.2 * system.position(i);
      const Vector r     = residual(system, s);
      const double force = system.parameters().area * system.parameters().material.stress(0.2);
      for (unsigned int i = 1; i + 1 < r.size(); ++i)
        EXPECT_NEAR(r(i), 0, 1e-14 * force);
      EXPECT_NEAR(r(r.size() - 1), force, 1e-13 * force) << "the moving end pulls";
      EXPECT_NEAR(r(0), -force, 1e-13 * force);
    }
}

TEST(Rod1d, itsMassIsThatOfTheRod)
{
  Solvers           solvers;
  const Rod1dSystem system(parameters(3, true), solvers.ledger);
  State             s = system.initial_state(0);
  s.a                 = 1;
  double sum          = 0;
  for (const double force : residual(system, s))
    sum += force;
  EXPECT_NEAR(sum, 1060 * 0.1 * 1e-4, 1e-16);
}

TEST(Rod1d, saysSoWhereTheStretchIsNotPositive)
{
  Solvers           solvers;
  const Rod1dSystem system(parameters(2, false), solvers.ledger);
  State             s = system.initial_state(0);
  s.u(3)              = 1;
  Vector           r(s.u);
  const Evaluation evaluation = system.residual({0, Side::left, s.u, s.v, s.a}, r);
  EXPECT_FALSE(evaluation.admissible);
  EXPECT_TRUE(std::isnan(r(1)));
}

/// Eigenfrequencies (2 k - 1)... of a fixed-fixed linear rod: omega_k = k pi/L sqrt(E/rho). One free oscillation of the first mode.
TEST(Rod1d, swingsWithItsFirstFrequency)
{
  for (const unsigned int degree : {1u, 2u, 3u})
    {
      Rod1dParameters p = parameters(degree, true);
      p.n_elements      = 32;
      p.strain          = sine(0, 1);
      const double pi = 3.14159265358979323846, omega = pi / p.length * std::sqrt(p.material.young / p.density);
      Rod          rod(p, "sdirk3");
      for (unsigned int i = 0; i < rod.state.u.size(); ++i)
        rod.state.u(i) = 1e-3 * std::sin(pi * rod.system.position(i) / p.length);
      const double mode = rod.state.u(16 * degree), period = 2 * pi / omega;
      rod.run(period, period / 200);
      EXPECT_NEAR(rod.state.u(16 * degree), mode, 1e-4 * mode) << degree;
    }
}

/// The direct solver for bands and the general one reach the same states.
TEST(Rod1d, bandAndGeneralSolversAgree)
{
  Rod1dParameters p = parameters(2, false);
  Rod             bands(p, "sdirk2");
  bands.run(0.05, 0.005);
  Solvers     general({"relative tolerance=1e-12", "absolute tolerance=1e-12"}, {}, {"type=direct"});
  Rod1dSystem system(p, general.ledger);
  const auto &entry = integrator_entry("sdirk2");
  const auto  integrator =
      entry.make(node(entry.schema), {system, general.nonlinear, BoundaryRates::scheme, general.ledger, StartVelocity::impulse});
  State state = starting_state(system, 0, BoundaryRates::scheme, StartVelocity::impulse);
  for (unsigned int i = 0; i < 10; ++i)
    ASSERT_TRUE(integrator->step(0.005, state).accepted());
  state.u -= bands.state.u;
  EXPECT_LT(state.u.linfty_norm(), 1e-13);
  EXPECT_GT(bands.solvers.ledger.counted("newton iterations"), 20u);
}

TEST(Rod1d, aLinearRodIsFactorisedOncePerSetOfWeights)
{
  Rod rod(parameters(2, true), "sdirk2");
  rod.run(0.5, 0.03125);
  EXPECT_EQ(rod.solvers.ledger.counted("linearisations"), 1u);
  EXPECT_EQ(rod.solvers.ledger.counted("jacobian assemblies"), 1u);
  EXPECT_EQ(rod.solvers.ledger.counted("preconditioner set-ups"), 1u);
}

TEST(Rod1d, aStepThatCannotBeSolvedIsAValue)
{
  Rod1dParameters p = parameters(2, false);
  p.strain =
      std::make_shared<SmoothDrive>([](double t) { return t > 0.5 ? -1.5 : 0.; }, [](double) { return 0.; }, [](double) { return 0.; });
  Rod              rod(p, "backward euler");
  const Vector     before = rod.state.u;
  const StepReport report = rod.integrator->step(1, rod.state);
  EXPECT_FALSE(report.accepted());
  EXPECT_FALSE(report.reason.empty());
  EXPECT_TRUE(std::equal(before.begin(), before.end(), rod.state.u.begin()));
}

/// Forces are the derivatives of the stored energy, and M v those of the kinetic one.
TEST(Rod1d, itsForcesAreDerivativesOfItsEnergy)
{
  for (const bool linear : {true, false})
    {
      WorkLedger        ledger;
      const Rod1dSystem system(parameters(2, linear), ledger);
      State             state = random_state(system, 1e-3);
      const auto        slope = [&](Vector State::*x, const unsigned int i, double Rod1dSystem::Energy::*part) {
        const double h = 1e-6;
        State        other(state);
        const double x0 = (state.*x)[i];
        (other.*x)[i]   = x0 + h;
        const double up = system.energy(other).*part;
        (other.*x)[i]   = x0 - h;
        return (up - system.energy(other).*part) / (2 * h);
      };
      State resting(state), moving(state);
      resting.a          = 0;
      moving.u           = 0;
      moving.a           = state.v;
      const Vector force = residual(system, resting), momentum = residual(system, moving);
      for (unsigned int i = 0; i < force.size(); ++i)
        {
          EXPECT_NEAR(slope(&State::u, i, &Rod1dSystem::Energy::stored), force[i], 1e-5 * force.linfty_norm()) << i;
          EXPECT_NEAR(slope(&State::v, i, &Rod1dSystem::Energy::kinetic), momentum[i], 1e-6 * momentum.linfty_norm()) << i;
        }
    }
}

/// dE/dt = rates + sum of r v over the free nodes and the fixed one, at any state.
TEST(Rod1d, energyAndItsRatesBelongToTheResidual)
{
  for (const bool linear : {true, false})
    for (const unsigned int degree : {1u, 2u, 3u})
      {
        WorkLedger        ledger;
        const Rod1dSystem system(parameters(degree, linear), ledger);
        const State       s      = random_state(system, 1e-3);
        const double      h      = 1e-4;
        const auto        energy = [&](const double part) {
          State moved = s;
          for (unsigned int i = 0; i < s.u.size(); ++i)
            {
              moved.u(i) += part * s.v(i);
              moved.v(i) += part * s.a(i);
            }
          return system.energetics(moved, Side::left).energy;
        };
        const Vector r        = residual(system, s);
        double       expected = system.energetics(s, Side::left).rates.external, size = 0;
        for (unsigned int i = 0; i + 1 < r.size(); ++i)
          {
            expected += r(i) * s.v(i);
            size += std::abs(r(i) * s.v(i));
          }
        EXPECT_NEAR((energy(h) - energy(-h)) / (2 * h), expected, 1e-6 * size) << degree << linear;
        EXPECT_EQ(system.energy_rates(s).external, system.energetics(s, Side::left).rates.external);
      }
}
