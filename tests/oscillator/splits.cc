// SPDX-License-Identifier: LGPL-2.1-or-later
// The split of the oscillator, and systems linearised at rest, by hand.

#include "../support/drives.h"
#include "../support/taylor.h"

#include <myolines/oscillator/oscillator_system.h>
#include <myolines/system/linearised_system.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  OscillatorParameters duffing()
  {
    OscillatorParameters p;
    p.mass            = 0.7;
    p.damping         = 0.3;
    p.stiffness       = 2;
    p.cubic_stiffness = 5;
    p.force           = sine(1.1, 2);
    p.support         = std::make_shared<Ramp>(0.5, 1);
    return p;
  }

  State some_state(const SemiDiscreteSystem &system)
  {
    State s = system.initial_state(0.37);
    s.u(0)  = 0.8;
    s.u(1)  = -0.4;
    s.v(0)  = 1.7;
    s.v(1)  = 0.2;
    s.a(0)  = -3;
    return s;
  }
} // namespace

TEST(OscillatorSplits, linearIsEverythingButTheCubicSpring)
{
  WorkLedger             ledger;
  const OscillatorSystem whole(duffing(), ledger);
  const auto             part = whole.implicit_part("linear");
  ASSERT_NE(part, nullptr);
  const State  s    = some_state(whole);
  const double rest = 0.7 * s.a(0) + 0.3 * (s.v(0) - s.v(1)) + 2 * (s.u(0) - s.u(1)) - 1.1 * std::sin(2 * 0.37);
  EXPECT_NEAR(residual_at(*part, s)(0), rest, 1e-14);
  EXPECT_NEAR(residual_at(whole, s)(0) - residual_at(*part, s)(0), 5 * std::pow(1.2, 3), 1e-14);
  EXPECT_TRUE(part->capabilities().linear);
  EXPECT_LT(taylor_error(*part, s, {1, 3, 7}, s.u, 1e-2), 1e-12);
  EXPECT_EQ(part->events(0, 1), whole.events(0, 1));
}

TEST(OscillatorSplits, thoseOfCapabilitiesAreThereAndNoOthers)
{
  WorkLedger             ledger;
  const OscillatorSystem whole(duffing(), ledger);
  for (const Split &split : whole.capabilities().splits)
    {
      EXPECT_NE(whole.implicit_part(split.name), nullptr) << split.name;
      EXPECT_EQ(split.refused, "");
    }
  EXPECT_EQ(whole.implicit_part("volumetric"), nullptr);
}

TEST(LinearisedSystem, isWhatTheSystemIsForSmallMotionsWithoutLoads)
{
  WorkLedger                              ledger;
  std::unique_ptr<const LinearisedSystem> system;
  {
    auto whole = std::make_unique<OscillatorSystem>(duffing(), ledger);
    system     = std::make_unique<LinearisedSystem>(std::move(whole));
  }
  const State s = some_state(*system);
  // no force of the drive, no cubic spring
  const double spring = 0.3 * (s.v(0) - s.v(1)) + 2 * (s.u(0) - s.u(1));
  EXPECT_NEAR(residual_at(*system, s)(0), 0.7 * s.a(0) + spring, 1e-14);
  EXPECT_NEAR(residual_at(*system, s)(1), -spring, 1e-14);
  EXPECT_LT(taylor_error(*system, s, {1, 3, 7}, s.u, 1e-2), 1e-12);
  EXPECT_TRUE(system->capabilities().linear);
  EXPECT_EQ(system->events(0, 1), std::vector<double>{0.5});

  State broken = s;
  broken.u(0)  = std::numeric_limits<double>::infinity();
  Vector r(s.u);
  EXPECT_FALSE(system->residual({0, Side::left, broken.u, broken.v, broken.a}, r).admissible);
}
