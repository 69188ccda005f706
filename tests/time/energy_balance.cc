// SPDX-License-Identifier: LGPL-2.1-or-later
// The sums of the balance of energy, fed with numbers of closed forms.

#include <myolines/time/energy_balance.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace myolines;

namespace
{
  /// Rates that are linear in time, which the trapezoidal rule integrates exactly, and the energy that follows from 2 J.
  Energetics linear(const double t) { return {2 + 1.5 * t * t - 0.5 * t - 0.25 * t * t + 4 * t, {3 * t, 0.5 + 0.5 * t, 4}}; }
} // namespace

TEST(EnergyBalance, ClosesWhereTheRuleIsExact)
{
  EnergyBalance balance;
  EXPECT_FALSE(balance.started());
  balance.restarted(0, linear(0));
  for (const double t : {0.1, 0.4, 1.})
    balance.accepted(t, linear(t));
  EXPECT_NEAR(balance.active_work(), 1.5, 1e-14);
  EXPECT_NEAR(balance.dissipated(), 0.75, 1e-14);
  EXPECT_NEAR(balance.external_work(), 4, 1e-14);
  EXPECT_NEAR(balance.report().drift, 0, 1e-14);
  EXPECT_NEAR(balance.report().exchanged, 2 + 1.5 + 0.75 + 4, 1e-14);
  EXPECT_LT(balance.report().rise.size, 1e-14);
}

TEST(EnergyBalance, StepsWithoutALookAtTheEnergyCount)
{
  EnergyBalance every, rare;
  every.restarted(0, linear(0));
  rare.restarted(0, linear(0));
  for (const double t : {0.1, 0.4, 1.})
    {
      every.accepted(t, linear(t));
      t < 1 ? rare.accepted(t, linear(t).rates) : rare.accepted(t, linear(t));
    }
  EXPECT_EQ(every.external_work(), rare.external_work());
  EXPECT_NEAR(rare.report().drift, 0, 1e-14);
}

TEST(EnergyBalance, TheEnergyOfAJumpIsWorkOfTheBoundary)
{
  EnergyBalance balance;
  balance.restarted(0, {1, {0, 0, 2}});
  balance.accepted(0.5, {2, {0, 0, 2}});
  balance.restarted(0.5, {2.75, {0, 0, -1}}); // the boundary turns round at once
  balance.accepted(1, {2.25, {0, 0, -1}});
  EXPECT_DOUBLE_EQ(balance.external_work(), 1 + 0.75 - 0.5);
  EXPECT_NEAR(balance.report().drift, 0, 1e-15);
}

TEST(EnergyBalance, TellsTheLargestRiseAndTheLargestStep)
{
  EnergyBalance balance;
  const auto    look = [&](const double t, const double energy) { balance.accepted(t, Energetics{energy, {}}); };
  look(0, 10);
  look(1, 8);
  look(2, 7);
  look(3, 9);
  look(4, 12);
  look(5, 11);
  look(6, 12.5);
  const EnergyReport &report = balance.report();
  EXPECT_EQ(report.drift, 2.5);
  EXPECT_EQ(report.exchanged, 10);
  EXPECT_EQ(report.rise.size, 5.5);
  EXPECT_EQ(report.rise.from, 2);
  EXPECT_EQ(report.rise.to, 6);
  EXPECT_EQ(report.jump.size, 3);
  EXPECT_EQ(report.jump.from, 3);
  EXPECT_EQ(report.jump.to, 4);
}

TEST(EnergyBalance, GoesOnFromWhatItSaved)
{
  EnergyBalance whole, first, second;
  const auto    bent = [](const double t) { return Energetics{std::cos(3 * t), {t * t, 0.1, std::sin(t)}}; };
  Archive       archive;
  first.save(archive);
  EXPECT_FALSE(archive.has_numbers("energy balance"));
  whole.restarted(0, bent(0));
  first.restarted(0, bent(0));
  for (const double t : {0.3, 0.5})
    for (EnergyBalance *balance : {&whole, &first})
      balance->accepted(t, bent(t));
  first.save(archive);
  second.load(archive);
  for (EnergyBalance *balance : {&whole, &second})
    balance->accepted(0.9, bent(0.9));
  EXPECT_EQ(whole.report().drift, second.report().drift);
  EXPECT_EQ(whole.report().exchanged, second.report().exchanged);
  EXPECT_EQ(whole.report().rise.size, second.report().rise.size);
  EXPECT_EQ(whole.report().jump.from, second.report().jump.from);
  EXPECT_EQ(whole.active_work(), second.active_work());
}
