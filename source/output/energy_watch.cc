// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/energy_watch.h>

#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    class EnergyWatch : public Observer
    {
    public:
      EnergyWatch(const SemiDiscreteSystem &system, std::function<EnergyRates(const State &)> rates, const OutputFolder &folder)
        : system_(system)
        , rates_(std::move(rates))
      {
        if (folder.saved != nullptr)
          balance_.load(*folder.saved);
      }

      void begin(const State &state) override { restarted(state); }
      void restarting(const State &state) override { look(state); }
      void restarted(const State &state) override { balance_.restarted(state.t, system_.energetics(state, Side::right)); }
      void last(const State &state) override { look(state); }

      void accepted(const State &state, const StepRecord &record) override
      {
        constexpr std::size_t steps_between_looks = 16; // a look at the energy of a rod costs up to a fifth of a step
        if (balance_.started() && record.number % steps_between_looks != 0)
          balance_.accepted(state.t, rates_(state));
        else
          look(state);
      }

      void save(Archive &archive) const override { balance_.save(archive); }

      const EnergyBalance *energy_balance() const override { return &balance_; }

    private:
      void look(const State &state)
      {
        if (!balance_.looked_at(state.t))
          balance_.accepted(state.t, system_.energetics(state, Side::left));
      }

      const SemiDiscreteSystem                       &system_;
      const std::function<EnergyRates(const State &)> rates_;
      EnergyBalance                                   balance_;
    };
  } // namespace

  std::unique_ptr<Observer> make_energy_watch(const SemiDiscreteSystem &system, std::function<EnergyRates(const State &)> rates,
                                              const OutputFolder &folder)
  {
    return std::make_unique<EnergyWatch>(system, std::move(rates), folder);
  }

  std::vector<std::string> energy_lines(const EnergyReport &report, const std::string &method)
  {
    constexpr double noticed = 0.01, alarming = 0.05; // parts of the energy exchanged
    if (report.exchanged == 0)
      return {};
    const auto number = [](const double x) {
      std::ostringstream text;
      text.precision(3);
      text << x;
      return text.str();
    };
    const auto part = [&](const double energy) {
      return number(energy) + " J, " + number(100 * energy / report.exchanged) + " % of the " + number(report.exchanged) + " J exchanged";
    };
    std::vector<std::string> lines;
    if (!std::isfinite(report.drift))
      lines.push_back("Warning: the energy of the last state is no number, as the volume at a point of the body is not positive there: \"" +
                      method + "\" ends its steps at states at which it does not look. To try: shorter steps, or another method");
    else if (report.drift < -noticed * report.exchanged)
      lines.push_back("Energy: " + part(-report.drift) + ", went into numerical dissipation of \"" + method + "\".");
    else
      lines.push_back("Energy: the balance drifts by " + part(report.drift) + ".");
    if (report.rise.size > alarming * report.exchanged)
      {
        std::ostringstream text;
        text << "Warning: from t = " << report.rise.from << " s to t = " << report.rise.to << " s the balance of energy gains "
             << part(report.rise.size) << ", most of it from t = " << report.jump.from << " s to t = " << report.jump.to << " s ("
             << number(report.jump.size) << " J): \"" << method
             << "\" is wrong there, or its steps are much too long. To try: shorter steps, another method, or a \"largest gain\" in "
                "time/control, which refuses such steps";
        lines.push_back(text.str());
      }
    return lines;
  }
} // namespace myolines
