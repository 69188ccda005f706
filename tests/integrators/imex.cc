// SPDX-License-Identifier: LGPL-2.1-or-later
// Implicit-explicit Euler: what it says of splits, and its limit of stability where both parts are a spring and a damper.

#include "experiment.h"

#include <myolines/base/error.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  /// a + (c_I + c_E) v + (k_I + k_E) u = 0 with the split `shared`.
  struct Shares
  {
    double k_implicit, k_explicit, c_implicit, c_explicit;

    /// dt^2 (k_E - k_I) + 2 dt (c_E - c_I) = 4
    double limit() const
    {
      const double k = k_explicit - k_implicit, c = c_explicit - c_implicit;
      return 4 / (c + std::sqrt(c * c + 4 * k));
    }
  };

  OscillatorParameters springs(const double k, const double c)
  {
    OscillatorParameters p;
    p.stiffness = k;
    p.damping   = c;
    return p;
  }

  class Shared : public OscillatorSystem
  {
  public:
    Shared(const Shares &shares, WorkLedger &ledger, std::string refused = "")
      : OscillatorSystem(springs(shares.k_implicit + shares.k_explicit, shares.c_implicit + shares.c_explicit), ledger)
      , shares_(shares)
      , ledger_(ledger)
      , refused_(std::move(refused))
    {}

    Capabilities capabilities() const override
    {
      Capabilities c = OscillatorSystem::capabilities();
      c.splits       = {{"shared", "a part of the spring and of the damper", refused_}};
      return c;
    }

    std::unique_ptr<SemiDiscreteSystem> implicit_part(const std::string &) const override
    {
      return std::make_unique<OscillatorSystem>(springs(shares_.k_implicit, shares_.c_implicit), ledger_);
    }

  private:
    Shares      shares_;
    WorkLedger &ledger_;
    std::string refused_;
  };

  std::unique_ptr<Integrator> make(const SemiDiscreteSystem &system, Solvers &solvers, const Overrides &parameters)
  {
    const IntegratorEntry &entry = integrator_entry("imex euler");
    return make_integrator(entry, node(entry.schema, parameters), {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
  }

  std::string refusal(const SemiDiscreteSystem &system, Solvers &solvers, const Overrides &parameters)
  {
    try
      {
        make(system, solvers, parameters);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(ImexEuler, itsLimitOfStabilityIsSharp)
{
  for (const Shares &shares : {Shares{0, 100, 0, 0}, Shares{30, 100, 0, 0}, Shares{0, 100, 0, 15}, Shares{30, 100, 3, 5}})
    for (const double part : {0.999, 1.001})
      {
        Solvers      solvers(Experiment::tight());
        const Shared system(shares, solvers.ledger);
        const auto   integrator = make(system, solvers, {"split=shared"});
        State        state      = system.initial_state(0);
        integrator->start(state);
        // just below the limit of the undamped oscillator its motion is large, but bounded
        constexpr double large = 1e3;
        for (unsigned int i = 0; i < 20000 && std::abs(state.u(0)) < large; ++i)
          ASSERT_TRUE(integrator->step(part * shares.limit(), state).accepted());
        EXPECT_EQ(std::abs(state.u(0)) < large, part < 1) << shares.k_implicit << " " << shares.c_explicit << ": " << state.u(0);
      }
}

TEST(ImexEuler, oneStepIsThatOfTheFormulas)
{
  // v_1 (1 + dt c_I + dt^2 k_I) = v_0 (1 - dt c_E) - dt (k_I + k_E) u_0
  const Shares shares{30, 100, 3, 5};
  Solvers      solvers(Experiment::tight());
  const Shared system(shares, solvers.ledger);
  const auto   integrator = make(system, solvers, {"split=shared"});
  State        state      = system.initial_state(0);
  state.v(0)              = 0.3;
  integrator->start(state);
  const double dt = 0.05;
  ASSERT_TRUE(integrator->step(dt, state).accepted());
  const double v = (0.3 * (1 - dt * 5) - dt * 130) / (1 + dt * 3 + dt * dt * 30);
  EXPECT_NEAR(state.v(0), v, 1e-14);
  EXPECT_NEAR(state.u(0), 1 + dt * v, 1e-14);
  EXPECT_NEAR(state.a(0), (v - 0.3) / dt, 1e-12);
}

TEST(ImexEuler, withTheTangentOneStepIsTheLinearisedOne)
{
  // u'' + u + 2 u^3 = 0 at u = 1, v = 0.3: (1 + dt^2 7) a = -3 - dt 7 0.3
  OscillatorParameters duffing;
  duffing.cubic_stiffness = 2;
  duffing.velocity        = 0.3;
  Experiment experiment(integrator_entry("imex euler"), duffing);
  experiment.integrator->start(experiment.state);
  const double dt = 0.1;
  ASSERT_TRUE(experiment.integrator->step(dt, experiment.state).accepted());
  const double a = -(3 + dt * 7 * 0.3) / (1 + dt * dt * 7);
  EXPECT_NEAR(experiment.state.v(0), 0.3 + dt * a, 1e-14);
  EXPECT_NEAR(experiment.state.u(0), 1 + dt * (0.3 + dt * a), 1e-14);
}

TEST(ImexEuler, saysWhichSplitsThereAre)
{
  Solvers           solvers;
  const Shared      system({1, 1, 0, 0}, solvers.ledger);
  const std::string message = refusal(system, solvers, {"split=shred"});
  EXPECT_NE(message.find("no split \"shred\""), std::string::npos) << message;
  EXPECT_NE(message.find("one of tangent at the start of the step, shared"), std::string::npos) << message;
  EXPECT_NE(message.find("nearest valid name: \"shared\""), std::string::npos) << message;
}

TEST(ImexEuler, refusesASplitAsTheSystemSaysUnlessForced)
{
  Solvers           solvers;
  const Shared      system({1, 1, 0, 0}, solvers.ledger, "it cannot");
  const std::string message = refusal(system, solvers, {"split=shared"});
  EXPECT_NE(message.find("the split \"shared\" is refused: it cannot"), std::string::npos) << message;
  EXPECT_NE(message.find("\"force\" = \"true\""), std::string::npos) << message;
  EXPECT_NO_THROW(make(system, solvers, {"split=shared", "force=true"}));
}
