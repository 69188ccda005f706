// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/step_doubling.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    class StepDoubling : public Integrator
    {
    public:
      StepDoubling(std::unique_ptr<Integrator> method, const unsigned int order, const ErrorNorm &norm)
        : method_(std::move(method))
        , divisor_(std::exp2(order) - 1)
        , norm_(norm)
      {}

      void start(State &state) override { method_->start(state); }

      StepReport step(const double dt, State &state) override
      {
        Archive memory;
        method_->save(memory);
        StepReport report = try_both_ways(dt, state, memory);
        if (report.accepted())
          swap(state, halves_);
        else
          method_->load(memory);
        return report;
      }

      void save(Archive &archive) const override { method_->save(archive); }
      void load(const Archive &archive) override { method_->load(archive); }

    private:
      StepReport try_both_ways(const double dt, const State &state, const Archive &memory)
      {
        whole_            = state;
        halves_           = state;
        StepReport report = method_->step(dt, whole_);
        if (!report.accepted())
          return report;
        method_->load(memory);
        for (const double end : {state.t + dt / 2, state.t + dt})
          {
            add(method_->step(end - halves_.t, halves_), report);
            if (!report.accepted())
              return report;
            halves_.t = end;
          }
        combine(whole_.u, {{1 / divisor_, &halves_.u}, {-1 / divisor_, &whole_.u}});
        combine(whole_.v, {{1 / divisor_, &halves_.v}, {-1 / divisor_, &whole_.v}});
        ErrorNorm::judge(norm_.of_step(whole_.u, &whole_.v, state, halves_), report);
        return report;
      }

      static void add(const StepReport &part, StepReport &sum)
      {
        const StepReport before = sum;
        sum                     = part;
        sum.newton_iterations += before.newton_iterations;
        sum.linear_iterations += before.linear_iterations;
        sum.residual_evaluations += before.residual_evaluations;
      }

      const std::unique_ptr<Integrator> method_;
      const double                      divisor_;
      const ErrorNorm                  &norm_;
      State                             whole_, halves_;
    };
  } // namespace

  std::unique_ptr<Integrator> make_step_doubling(const IntegratorEntry &entry, const scene::Node &integrator,
                                                 const IntegratorContext &context)
  {
    return std::make_unique<StepDoubling>(entry.make(integrator, context), facts_with(entry, integrator).order, *context.error_norm);
  }
} // namespace myolines
