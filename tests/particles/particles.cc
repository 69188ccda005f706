// SPDX-License-Identifier: LGPL-2.1-or-later
// The model problem of Bathe and Noh and the spring pendulum, by hand and with the methods that they are for.
#include "../support/drives.h"
#include "../support/solvers.h"
#include "../support/taylor.h"

#include <myolines/base/error.h>
#include <myolines/particles/mass_chain.h>
#include <myolines/particles/spring_pendulum.h>
#include <myolines/time/integrator.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  MassChainParameters model_problem()
  {
    MassChainParameters p;
    p.support = sine(1, 1.2);
    return p;
  }

  /// Steps of one method, the state visited after each.
  template <typename System, typename Parameters, typename Visitor>
  void go(const Parameters &parameters, const std::string &method, const Overrides &of_method, const double dt, const unsigned int steps,
          const Visitor &visit)
  {
    Solvers                solvers({"relative tolerance=3e-14", "absolute tolerance=0"});
    const System           system(parameters, solvers.ledger);
    const IntegratorEntry &entry = integrator_entry(method);
    const auto integrator = entry.make(node(entry.schema, of_method), {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
    State      state      = system.initial_state(0);
    integrator->start(state);
    for (unsigned int i = 0; i < steps; ++i)
      {
        const StepReport report = integrator->step(dt, state);
        ASSERT_TRUE(report.accepted()) << method << ", step " << i << ": " << report.reason;
        visit(system, state);
      }
  }

  double force_on_support(const MassChain &system, const State &state)
  {
    Vector r(state.u);
    system.residual({state.t, Side::left, state.u, state.v, state.a}, r);
    return r(0);
  }

  /// The motion without the vibration of the stiff spring, k_1 to infinity: u_1 = sin(w t), u_2'' + u_2 = u_1 from rest.
  struct SlowMotion
  {
    explicit SlowMotion(const double t)
    {
      const double w = 1.2, A = 1 / (1 - w * w);
      u[0]  = std::sin(w * t);
      u[1]  = A * (std::sin(w * t) - w * std::sin(t));
      a[0]  = -w * w * std::sin(w * t);
      a[1]  = A * (-w * w * std::sin(w * t) + w * std::sin(t));
      force = a[0] + u[0] - u[1];
    }
    double u[2], a[2], force;
  };

  struct Largest
  {
    double u = 0, a_stiff = 0, a_soft = 0, force = 0;
  };

  Largest errors_after_first_step(const std::string &method, const Overrides &of_method, const double dt)
  {
    Largest      largest;
    unsigned int step = 0;
    go<MassChain>(model_problem(), method, of_method, dt, 40, [&](const MassChain &system, const State &state) {
      if (++step == 1)
        return;
      const SlowMotion exact(state.t);
      for (const unsigned int i : {0, 1})
        largest.u = std::max(largest.u, std::abs(state.u(i + 1) - exact.u[i]));
      largest.a_stiff = std::max(largest.a_stiff, std::abs(state.a(1) - exact.a[0]));
      largest.a_soft  = std::max(largest.a_soft, std::abs(state.a(2) - exact.a[1]));
      largest.force   = std::max(largest.force, std::abs(force_on_support(system, state) - exact.force));
    });
    return largest;
  }

  constexpr double twentieth = 2 * M_PI / 1.2 / 20; // of the period of the support, the step of the paper
} // namespace

TEST(MassChain, isTheEquationOfMotion)
{
  WorkLedger          ledger;
  MassChainParameters p = model_problem();
  p.masses              = {2, 3, 0.5};
  p.stiffnesses         = {7, 11, 13};
  p.dampings            = {0.1, 0, 0.3};
  p.support_mass        = 4;
  const MassChain system(p, ledger);
  State           s = system.initial_state(0.4);
  for (unsigned int i = 1; i < 4; ++i)
    {
      s.u(i) = 0.1 * i * i;
      s.v(i) = 1 - 0.2 * i;
      s.a(i) = 0.3 * i;
    }
  const double f1 = 7 * (s.u(1) - s.u(0)) + 0.1 * (s.v(1) - s.v(0)), f2 = 11 * (s.u(2) - s.u(1)),
               f3 = 13 * (s.u(3) - s.u(2)) + 0.3 * (s.v(3) - s.v(2));
  const Vector r  = residual_at(system, s);
  EXPECT_NEAR(r(0), 4 * s.a(0) - f1, 1e-13);
  EXPECT_NEAR(r(1), 2 * s.a(1) + f1 - f2, 1e-13);
  EXPECT_NEAR(r(2), 3 * s.a(2) + f2 - f3, 1e-13);
  EXPECT_NEAR(r(3), 0.5 * s.a(3) + f3, 1e-13);
  EXPECT_DOUBLE_EQ(s.u(0), std::sin(1.2 * 0.4));
}

TEST(MassChain, WithoutTheStiffModeAfterTheFirstStepOfTheCompositeMethod)
{
  for (const Overrides &first : {Overrides{"spectral radius=0"}, Overrides{"spectral radius=0", "first step=own"}})
    {
      const Largest e = errors_after_first_step("bathe", first, twentieth), half = errors_after_first_step("bathe", first, twentieth / 2);
      EXPECT_LT(e.u, 0.1);
      EXPECT_LT(half.u, 0.03);
      EXPECT_LT(e.a_soft, 0.1);
      EXPECT_LT(e.a_stiff, 0.15); // of first order, as the motion of the stiff spring is given
      EXPECT_LT(half.a_stiff, 0.1);
      EXPECT_LT(e.force, 0.15);
      EXPECT_LT(half.force, 0.1);
    }
}

TEST(MassChain, RingsWithAverageAccelerations)
{
  const Largest e = errors_after_first_step("newmark", {"first step=own"}, twentieth);
  EXPECT_LT(e.u, 0.2);
  EXPECT_GT(e.a_stiff, 5);
  EXPECT_GT(e.force, 5);
  EXPECT_GT(errors_after_first_step("newmark", {"first step=own"}, twentieth / 2).a_stiff, e.a_stiff) << "shorter steps do not help";
  EXPECT_GT(errors_after_first_step("newmark", {}, twentieth).a_stiff, 1) << "nor does an L-stable first step";
}

namespace
{
  double distance(const State &state) { return std::hypot(state.u(0), state.u(1)); }

  double angular_momentum(const SpringPendulumParameters &p, const State &s) { return p.mass * (s.u(0) * s.v(1) - s.u(1) * s.v(0)); }

  /// Thrown across, so that it turns and vibrates.
  SpringPendulumParameters thrown()
  {
    SpringPendulumParameters p;
    p.mass      = 2;
    p.stiffness = 1e6;
    p.length    = 1.5;
    p.position  = {{1.5, 0}};
    p.velocity  = {{3, 20}};
    return p;
  }
} // namespace

TEST(SpringPendulum, ForcesOfTwoStatesDoTheWorkAndHaveNoMoment)
{
  WorkLedger           ledger;
  const auto           p = thrown();
  const SpringPendulum system(p, ledger);
  State                begin = system.initial_state(0), end = begin;
  begin.v = end.v = 0;
  end.u(0)        = -0.7;
  end.u(1)        = 1.9;
  Vector r(begin.u);
  ASSERT_TRUE(system.residual({0, Side::left, end.u, end.v, end.a, nullptr, &begin.u}, r).admissible);
  const double work = r(0) * (end.u(0) - begin.u(0)) + r(1) * (end.u(1) - begin.u(1));
  const double rise = system.energetics(end, Side::left).energy - system.energetics(begin, Side::left).energy;
  EXPECT_NEAR(work, rise, 1e-13 * p.stiffness);
  EXPECT_NEAR((begin.u(0) + end.u(0)) * r(1) - (begin.u(1) + end.u(1)) * r(0), 0, 1e-13 * p.stiffness);

  const auto linearisation = system.make_linearisation();
  struct Of
  {
    const Vector *before;
    double        dissipation;
  };
  for (const auto &[before, dissipation] : {Of{nullptr, 0}, Of{&begin.u, 0}, Of{&begin.u, 0.6}})
    {
      system.linearise({0, Side::left, end.u, end.v, end.a, nullptr, before, dissipation}, *linearisation);
      for (const unsigned int c : {0, 1})
        {
          Vector       direction(end.u), line(end.u), up(end.u), down(end.u);
          const double h = 1e-5;
          direction      = 0;
          direction(c)   = 1;
          linearisation->apply(stage_weights(1, 0, 0), direction, line);
          for (const double sign : {1., -1.})
            {
              Vector u(end.u);
              u(c) += sign * h;
              system.residual({0, Side::left, u, end.v, end.a, nullptr, before, dissipation}, sign > 0 ? up : down);
            }
          for (const unsigned int i : {0, 1})
            EXPECT_NEAR(line(i), (up(i) - down(i)) / (2 * h), 1e-8 * p.stiffness);
        }
    }
}

/// A circle stays one: of equal lengths the force is that of a linear spring of w^2 = k (1 - L/r)/m, by which a step turns 2 atan(w dt/2).
TEST(SpringPendulum, TurnsOnACircle)
{
  SpringPendulumParameters p = thrown();
  const double             r = 1.6, w = std::sqrt(p.stiffness * (1 - p.length / r) / p.mass), dt = 0.02;
  p.position        = {{r, 0}};
  p.velocity        = {{0, w * r}};
  unsigned int step = 0;
  go<SpringPendulum>(p, "energy momentum", {}, dt, 50, [&](const SpringPendulum &, const State &state) {
    const double angle = 2 * std::atan(w * dt / 2) * ++step;
    EXPECT_NEAR(state.u(0), r * std::cos(angle), 1e-9);
    EXPECT_NEAR(state.u(1), r * std::sin(angle), 1e-9);
  });
}

TEST(SpringPendulum, KeepsEnergyAndAngularMomentumInLongSteps)
{
  const SpringPendulumParameters p        = thrown();
  const double                   at_start = p.mass * 1.5 * 20, energy = p.mass * (9 + 400) / 2;
  double                         longest = 0;
  go<SpringPendulum>(p, "energy momentum", {}, 5e-3, 10000, [&](const SpringPendulum &system, const State &state) {
    EXPECT_NEAR(system.energetics(state, Side::left).energy, energy, 1e-9 * energy);
    EXPECT_NEAR(angular_momentum(p, state), at_start, 1e-10 * at_start);
    longest = std::max(longest, distance(state));
  });
  EXPECT_LT(longest, 1.6);
}

/// The vibration along the spring fades, the turn about the origin stays: angular momentum to what the solves leave, energy never more than
/// before, and in the end that of the turn on the circle with this angular momentum.
TEST(SpringPendulum, LosesItsVibrationButNotItsAngularMomentum)
{
  const SpringPendulumParameters p        = thrown();
  const double                   at_start = p.mass * 1.5 * 20;
  double                         last = p.mass * (9 + 400) / 2, r = 1.6;
  go<SpringPendulum>(p, "dissipative energy momentum", {"spectral radius at infinity=0.5"}, 5e-3, 4000,
                     [&](const SpringPendulum &system, const State &state) {
                       const double energy = system.energetics(state, Side::left).energy;
                       EXPECT_LE(energy, last * (1 + 1e-12)) << state.t;
                       EXPECT_NEAR(angular_momentum(p, state), at_start, 1e-10 * at_start) << state.t;
                       last = energy;
                       r    = distance(state);
                     });
  const double tension = p.stiffness * (r - p.length); // of the circle: m v^2/r with m r v the angular momentum
  EXPECT_NEAR(tension, at_start * at_start / (p.mass * r * r * r), 2e-2 * tension);
  EXPECT_NEAR(last, at_start * at_start / (2 * p.mass * r * r), 0.5);
}

/// With a stiff spring its period under gravity is that of the rigid pendulum, 4 K(sin(angle/2)) sqrt(L/g), by the arithmetic-geometric
/// mean.
TEST(SpringPendulum, SwingsAsARigidOne)
{
  SpringPendulumParameters p;
  p.stiffness = 1e7;
  p.gravity   = 9.81;
  p.position  = {{1, 0}}; // 90 degrees
  p.velocity  = {{0, 0}};
  double a = 1, b = std::cos(M_PI / 4);
  for (unsigned int i = 0; i < 6; ++i)
    {
      const double mean = (a + b) / 2;
      b                 = std::sqrt(a * b);
      a                 = mean;
    }
  const double       period = 2 * M_PI / a * std::sqrt(p.length / p.gravity);
  const unsigned int steps  = 4000;
  for (const char *method : {"energy momentum", "bathe"})
    {
      State end;
      go<SpringPendulum>(p, method, {}, period / steps, steps, [&](const SpringPendulum &, const State &state) { end = state; });
      EXPECT_NEAR(end.u(0), 1, 1e-4) << method;
      EXPECT_NEAR(end.u(1), 0, 5e-3) << method;
    }
}

TEST(SpringPendulum, RefusesThePlaceWithoutADirection)
{
  EXPECT_THROW(read_spring_pendulum(node(spring_pendulum_schema(), {"position=0 0"})), InputError);
  EXPECT_THROW(read_spring_pendulum(node(spring_pendulum_schema(), {"velocity=1"})), InputError);
  EXPECT_THROW(read_mass_chain(node(mass_chain_schema(), {"support/type=constant", "support/value=0", "stiffnesses=1"})), InputError);
}
