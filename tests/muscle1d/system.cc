// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/taylor.h"
#include "run.h"

#include <cmath>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  Muscle1dParameters unit(const Overrides &settings) { return read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), settings)); }
  Muscle1dParameters continuum(const Overrides &settings) { return read_continuum_muscle(node(continuum_muscle_schema(), settings)); }

  /// Somewhere smooth: away from the knots of the curves.
  State somewhere(const Muscle1dSystem &system)
  {
    State state = system.initial_state(0.37);
    for (unsigned int i = 0; i < state.u.size(); ++i)
      {
        state.u(i) += 1e-4 * std::sin(1. + 2 * i);
        state.v(i) = 0.3 * std::cos(0.3 + i);
        state.a(i) = std::sin(5. * i);
      }
    return state;
  }

  void expect_exact_linearisation(const Muscle1dParameters &parameters, const std::string &name)
  {
    WorkLedger           ledger;
    const Muscle1dSystem system(parameters, ledger);
    const State          state = somewhere(system);
    Vector               x(state.u);
    for (unsigned int i = 0; i < x.size(); ++i)
      x(i) = 1e-4 * std::cos(2. * i + 0.1);
    EXPECT_LT(taylor_error(system, state, {1, 0, 0}, x, 1e-2), 1e-7) << name << " K";
    EXPECT_LT(taylor_error(system, state, {0, 1, 0}, x, 1), 1e-7) << name << " C";
    if (system.capabilities().inertia)
      {
        EXPECT_LT(taylor_error(system, state, {0, 0, 1}, x, 1e3), 1e-8) << name << " M";
      }
  }
} // namespace

TEST(Muscle1d, isLinearisedExactly)
{
  expect_exact_linearisation(unit({"masses=0", "task=walking"}), "massless");
  expect_exact_linearisation(unit({"masses=7", "muscle=MG"}), "masses");
  expect_exact_linearisation(continuum({"elements=3", "degree=4", "grading=1", "base material fraction=0.1"}), "continuum");
  expect_exact_linearisation(continuum({"elements=4", "degree=2", "grading=0.3", "mass=consistent"}), "graded continuum");
  expect_exact_linearisation(read_isometric_chain(node(isometric_chain_schema(), {"elements=6", "base material fraction=0.01"})), "chain");
}

// Element 2 of 4 lengthens at 20 e_0: it pulls its nodes together by the printed force, and nothing else changes.
TEST(Muscle1d, frontsAreViscousAndNothingElse)
{
  WorkLedger               ledger;
  const Overrides          graded{"elements=4", "degree=1", "grading=0.5"};
  const Muscle1dParameters viscous = continuum(graded);
  Muscle1dParameters       plain   = viscous;
  plain.front_viscosity            = 0;
  const Muscle1dSystem with(viscous, ledger), without(plain, ledger);
  State                state = somewhere(with);
  Vector               same  = residual_at(with, state);
  same -= residual_at(without, state);
  EXPECT_EQ(same.linfty_norm(), 0);

  const double ratio = std::pow(0.5, 1. / 3), sum = 1 + ratio + ratio * ratio + 0.5, h = ratio * ratio / sum; // of the third element
  const double e_0 = viscous.force.maximum_strain_rate;
  state.v          = 0;
  for (const unsigned int node : {2, 3})
    state.v(node) = 20 * e_0 * h * viscous.optimal_length;
  Vector difference = residual_at(with, state);
  difference -= residual_at(without, state);
  const double force = 1 * viscous.mass * viscous.optimal_length * e_0 * e_0 * h * h * 12 * 12;
  EXPECT_NEAR(difference(1), -force, 1e-12 * force);
  EXPECT_NEAR(difference(2), force, 1e-12 * force);
  EXPECT_EQ(difference(0), 0);
  EXPECT_EQ(difference(3), 0);

  Vector x(state.u);
  for (unsigned int i = 0; i < x.size(); ++i)
    {
      x(i) = 1e-4 * std::cos(2. * i + 0.1);
      state.v(i) += 0.3 * std::cos(0.3 + i); // away from the knot at rest
    }
  EXPECT_LT(taylor_error(with, state, {0, 1, 0}, x, 1), 1e-7);
}

TEST(Muscle1d, isLinearisedExactlyWithItsActivation)
{
  for (const bool of_continuum : {false, true})
    {
      WorkLedger           ledger;
      const Muscle1dSystem system(
          of_continuum ? continuum({"elements=2", "degree=3", "activation=unknown"}) : unit({"masses=3", "activation=unknown"}), ledger);
      const State state = somewhere(system);
      Vector      x(state.u);
      for (unsigned int i = 0; i < x.size(); ++i)
        x(i) = 1e-4 * std::cos(2. * i + 0.1);
      for (const Weights w : {Weights{1, 0, 0}, Weights{0, 1, 0}, Weights{0, 0, 1}})
        EXPECT_LT(taylor_error(system, state, {{w, w, w}}, w, x, w.u != 0 ? 1e-2 : 1), 1e-5);
    }
}

TEST(Muscle1d, startsInBalance)
{
  for (const Muscle1dParameters &p :
       {unit({"masses=5"}), unit({"masses=0", "scale=10"}), continuum({}), unit({"task=cycling", "muscle=VM"})})
    {
      WorkLedger           ledger;
      const Muscle1dSystem system(p, ledger);
      EXPECT_LT(residual_at(system, system.initial_state(0)).l2_norm(), 1e-9 * p.maximum_force);
    }
}

// One element of degree 1 is, but for its mass, the chain of one mass: half of it lumped, a third consistent.
TEST(Muscle1d, continuumOfOneElementIsOneSmallerMass)
{
  WorkLedger           ledger;
  const Muscle1dSystem chain(unit({"masses=1"}), ledger);
  const State          state = somewhere(chain);
  for (const auto &[mass, part] : {std::pair("lumped", 1. / 2), std::pair("blended", 4. / 9), std::pair("consistent", 1. / 3)})
    {
      const Muscle1dSystem element(continuum({"elements=1", "degree=1", std::string("mass=") + mass}), ledger);
      const Vector         r1 = residual_at(chain, state), r2 = residual_at(element, state);
      EXPECT_NEAR(r1(0) - r2(0), (1 - part) * chain.parameters().mass * state.a(0), 1e-12 * chain.parameters().maximum_force);
    }
}

// Of degree 1 and with lumped mass the continuum is the chain but for half the mass at its end: nothing else tells them apart.
TEST(Muscle1d, lumpedContinuumIsTheChainButForItsEnd)
{
  WorkLedger           ledger;
  const Muscle1dSystem chain(unit({"masses=9"}), ledger),
      element(continuum({"elements=9", "mass=lumped", "grading=1", "front viscosity=0"}), ledger);
  const State state      = somewhere(chain);
  Vector      difference = residual_at(chain, state);
  difference -= residual_at(element, state);
  EXPECT_NEAR(difference(8), chain.parameters().mass / 18 * state.a(8), 1e-12 * chain.parameters().maximum_force);
  difference(8) = 0;
  EXPECT_LT(difference.linfty_norm(), 1e-12 * chain.parameters().maximum_force);
}

TEST(Muscle1d, totalMassMoves)
{
  for (const Muscle1dParameters &p : {unit({"masses=5"}), continuum({"elements=3", "degree=5", "grading=1"}),
                                      continuum({"elements=3", "degree=5", "grading=1", "mass=consistent"})})
    {
      WorkLedger           ledger;
      const Muscle1dSystem system(p, ledger);
      const auto           linearisation = system.make_linearisation();
      const State          s             = system.initial_state(0);
      system.linearise({0, Side::right, s.u, s.v, s.a}, *linearisation);
      // u = X is stretching: kinetic energy m/6 of the continuum, m/(2 N^3) sum i^2 of the chain, at unit end velocity
      Vector x(s.u), y(s.u);
      double expected = p.mass / 3;
      if (p.mass_of == MassOf::points)
        {
          expected = 0;
          for (unsigned int i = 1; i <= 5; ++i)
            expected += p.mass / 5 * i * i / 25.;
          for (unsigned int i = 0; i < 5; ++i)
            x(i) = (i + 1) / 5.;
        }
      else
        {
          x             = 0;
          const auto gl = [](const unsigned int i) { // Gauss-Lobatto points of degree 5
            const double inner[] = {
                0, 0.1174723380352676535744985, 0.3573842417596774518429245, 0.6426157582403225481570755, 0.8825276619647323464255015, 1};
            return inner[i];
          };
          for (unsigned int e = 0; e < 3; ++e)
            for (unsigned int i = 1; i < 6; ++i)
              x(5 * e + i - 1) = (e + gl(i)) / 3;
        }
      linearisation->apply(stage_weights(0, 0, 1), x, y);
      EXPECT_NEAR(x * y, expected, 1e-13);
    }
}

// Lengths 4/7, 2/7 and 1/7 of the muscle: a uniform strain is one in all of them, and the consistent mass is exact for u = X.
TEST(Muscle1d, gradedElementsAreAGeometricSeries)
{
  WorkLedger           ledger;
  const Muscle1dSystem system(continuum({"elements=3", "grading=0.25", "mass=consistent"}), ledger);
  const double         length = system.parameters().optimal_length, ends[] = {4. / 7, 6. / 7, 1};
  State                state = system.initial_state(0);
  Vector               x(state.u), y(state.u);
  for (unsigned int i = 0; i < 3; ++i)
    {
      x(i)       = ends[i];
      state.u(i) = 0.02 * length * ends[i];
      state.v(i) = 0.3 * length * ends[i];
    }
  for (const double stretch : system.element_stretches(state.u))
    EXPECT_NEAR(stretch, system.parameters().initial_stretch + 0.02, 1e-14);
  const HillForce::Value expected =
      system.parameters().force(system.parameters().initial_stretch + 0.02, 0.3, system.parameters().activation->value(0));
  for (const double force : system.element_forces(0, state.u, state.v))
    EXPECT_NEAR(force, expected.force, 1e-13);
  const Vector residual = residual_at(system, state);
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_NEAR(residual(i), 0, 1e-12 * system.parameters().maximum_force);

  const auto linearisation = system.make_linearisation();
  system.linearise({0, Side::right, state.u, state.v, state.a}, *linearisation);
  linearisation->apply(stage_weights(0, 0, 1), x, y);
  EXPECT_NEAR(x * y, system.parameters().mass / 3, 1e-12);
}

TEST(Muscle1d, saysWhatIsInadmissible)
{
  WorkLedger           ledger;
  Muscle1dParameters   p = unit({"masses=4"});
  const Muscle1dSystem system(p, ledger);
  State                state = system.initial_state(0);
  Vector               r(state.u);
  EXPECT_TRUE(system.residual({1, Side::left, state.u, state.v, state.a}, r).admissible);
  state.u(0) = -1;
  EXPECT_FALSE(system.residual({0, Side::left, state.u, state.v, state.a}, r).admissible);
  EXPECT_TRUE(std::isnan(r(2)));
}
