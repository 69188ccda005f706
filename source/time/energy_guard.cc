// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/energy_balance.h>
#include <myolines/time/energy_guard.h>

#include <sstream>

namespace myolines
{
  namespace
  {
    constexpr const char *parameter = "largest gain";

    /// What the method remembers is put back, through its save() and load(), where a step is refused.
    class EnergyGuard : public Integrator
    {
    public:
      EnergyGuard(std::unique_ptr<Integrator> method, const double largest, const SemiDiscreteSystem &system)
        : method_(std::move(method))
        , largest_(largest)
        , system_(system)
      {}

      void start(State &state) override
      {
        method_->start(state);
        balance_.restarted(state.t, system_.energetics(state, Side::right));
      }

      StepReport step(const double dt, State &state) override
      {
        Archive memory;
        method_->save(memory);
        begin_            = state;
        StepReport report = method_->step(dt, state);
        if (!report.accepted())
          return report;
        EnergyBalance after = balance_;
        state.t             = begin_.t + dt;
        after.accepted(state.t, system_.energetics(state, Side::left));
        const double gain = after.report().drift - balance_.report().drift;
        if (gain <= largest_)
          {
            balance_ = after;
            return report;
          }
        swap(state, begin_);
        method_->load(memory);
        std::ostringstream text;
        text.precision(3);
        text << "the balance of energy gains " << gain << " J, more than " << largest_ << " J";
        report.outcome = StepReport::Outcome::energy_gained;
        report.reason  = text.str();
        return report;
      }

      void save(Archive &archive) const override
      {
        method_->save(archive);
        balance_.save(archive);
      }

      void load(const Archive &archive) override
      {
        method_->load(archive);
        balance_.load(archive);
      }

    private:
      const std::unique_ptr<Integrator> method_;
      const double                      largest_; ///< [J]
      const SemiDiscreteSystem         &system_;
      EnergyBalance                     balance_;
      State                             begin_;
    };
  } // namespace

  void add_largest_gain(scene::Schema &control)
  {
    control.optional_number(parameter, "J", scene::Range::positive(),
                            "A step in which the balance of energy gains more is refused, as one that fails. Not given: energies are not "
                            "looked at.");
  }

  std::unique_ptr<Integrator> guard_energy(std::unique_ptr<Integrator> method, const scene::Node &time, const SemiDiscreteSystem &system)
  {
    const scene::Node &control = time.section("control");
    if (!control.has(parameter))
      return method;
    if (!system.capabilities().energy)
      control.refuse(parameter, "the system does not state its energy", "no \"largest gain\"");
    return std::make_unique<EnergyGuard>(std::move(method), control.number(parameter), system);
  }
} // namespace myolines
