// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/midpoint_rule.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    class Composition : public Integrator
    {
    public:
      Composition(std::vector<double> parts, std::unique_ptr<Integrator> method)
        : parts_(std::move(parts))
        , method_(std::move(method))
      {}

      void start(State &state) override { method_->start(state); }

      StepReport step(const double dt, State &state) override
      {
        const double begin = state.t, end = begin + dt;
        const State  before = state;
        StepReport   report;
        double       done = 0;
        for (std::size_t i = 0; i < parts_.size(); ++i)
          {
            done += parts_[i];
            const double     until = i + 1 < parts_.size() ? begin + done * dt : end;
            const StepReport part  = method_->step(until - state.t, state);
            add(part, i == 0, report);
            if (!part.accepted())
              {
                state = before;
                return report;
              }
          }
        state.t = end;
        return report;
      }

      void save(Archive &archive) const override { method_->save(archive); }
      void load(const Archive &archive) override { method_->load(archive); }

    private:
      static void add(const StepReport &part, const bool first, StepReport &report)
      {
        const StepReport before = report;
        report                  = part;
        if (first)
          return;
        report.newton_iterations += before.newton_iterations;
        report.linear_iterations += before.linear_iterations;
        report.residual_evaluations += before.residual_evaluations;
        report.initial_residual = before.initial_residual;
      }

      const std::vector<double>         parts_;
      const std::unique_ptr<Integrator> method_;
    };

    bool is_composed(const scene::Node &integrator) { return integrator.text("composition") == "suzuki"; }

    /// alpha_m = alpha_f = 1/2, beta = 1/4, gamma = 1/2: u and v are those of the rule, whatever a_0 is.
    constexpr AlphaCoefficients midpoint{0.5, 0.5, 0.25, 0.5};

    MethodFacts facts_of_composition(MethodFacts facts, const scene::Node &integrator)
    {
      if (is_composed(integrator))
        {
          facts.order     = 4;
          facts.stability = "unconditional for oscillations that nothing damps; what is overdamped grows in the part back in time";
        }
      return facts;
    }

    std::unique_ptr<Integrator> make_midpoint_rule(const ForceEvaluation force, const MethodFacts &facts, const scene::Node &integrator,
                                                   const IntegratorContext &context)
    {
      IntegratorContext exact = context;
      exact.error_norm        = nullptr;
      auto rule               = make_alpha_method(midpoint, force, FirstStep::own, facts, integrator, exact);
      if (!is_composed(integrator))
        return rule;
      const double p = 1 / (4 - std::cbrt(4.));
      return std::make_unique<Composition>(std::vector<double>{p, p, 1 - 4 * p, p, p}, std::move(rule));
    }
  } // namespace

  IntegratorEntry midpoint_entry(const ForceEvaluation force, const MethodFacts &facts)
  {
    IntegratorEntry entry;
    entry.facts  = facts;
    entry.schema = scene::Schema(facts.summary);
    entry.schema.choice("composition", "none", {"none", "suzuki"},
                        "Whether a step is one of the method, of order 2, or of five parts, one of them back in time, of order 4 (Suzuki, "
                        "doi:10.1016/0375-9601(90)90962-N).");
    entry.facts_of_parameters = [facts](const scene::Node &node) { return facts_of_composition(facts, node); };
    entry.make                = [force, facts](const scene::Node &node, const IntegratorContext &context) {
      return make_midpoint_rule(force, facts, node, context);
    };
    return entry;
  }
} // namespace myolines
