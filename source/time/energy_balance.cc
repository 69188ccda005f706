// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/energy_balance.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    constexpr const char *entry = "energy balance";
  }

  void EnergyBalance::restarted(const double t, const Energetics &now)
  {
    if (!started())
      {
        energy_at_start_  = now.energy;
        report_.exchanged = std::abs(now.energy);
        looked_at_ = low_at_ = t;
      }
    else
      works_.external = now.energy - energy_at_start_ - works_.active + works_.dissipation - report_.drift;
    before_ = Instant{t, now.rates};
  }

  void EnergyBalance::accepted(const double t, const Energetics &now)
  {
    if (!started())
      return restarted(t, now);
    accepted(t, now.rates);
    look(t, now.energy);
  }

  void EnergyBalance::accepted(const double t, const EnergyRates &now)
  {
    const double half = (t - before_->t) / 2;
    for (double EnergyRates::*rate : {&EnergyRates::active, &EnergyRates::dissipation, &EnergyRates::external})
      {
        works_.*rate += half * (before_->rates.*rate + now.*rate);
        report_.exchanged += half * (std::abs(before_->rates.*rate) + std::abs(now.*rate));
      }
    before_ = Instant{t, now};
  }

  void EnergyBalance::look(const double t, const double energy)
  {
    const double drift = energy - energy_at_start_ - works_.active + works_.dissipation - works_.external;
    if (const double step = drift - report_.drift; step > report_.jump.size)
      report_.jump = {looked_at_, t, step};
    if (drift < lowest_)
      {
        lowest_ = drift;
        low_at_ = t;
      }
    if (drift - lowest_ > report_.rise.size)
      report_.rise = {low_at_, t, drift - lowest_};
    report_.drift = drift;
    looked_at_    = t;
  }

  void EnergyBalance::save(Archive &archive) const
  {
    if (!started())
      return;
    const EnergyReport &r = report_;
    archive.put_numbers(entry, {before_->t, before_->rates.active, before_->rates.dissipation, before_->rates.external, energy_at_start_,
                                works_.active, works_.dissipation, works_.external, looked_at_, lowest_, low_at_, r.drift, r.exchanged,
                                r.rise.from, r.rise.to, r.rise.size, r.jump.from, r.jump.to, r.jump.size});
  }

  void EnergyBalance::load(const Archive &archive)
  {
    if (!archive.has_numbers(entry))
      return;
    const std::vector<double> &m = archive.numbers(entry);
    before_                      = Instant{m.at(0), {m.at(1), m.at(2), m.at(3)}};
    energy_at_start_             = m.at(4);
    works_                       = {m.at(5), m.at(6), m.at(7)};
    looked_at_                   = m.at(8);
    lowest_                      = m.at(9);
    low_at_                      = m.at(10);
    report_                      = {m.at(11), m.at(12), {m.at(13), m.at(14), m.at(15)}, {m.at(16), m.at(17), m.at(18)}};
  }
} // namespace myolines
