// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/dirk_tables.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/start.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name      = "bdf2";
      facts.summary   = "Backward differences of second order, for steps of any ratio up to 1 + sqrt(2); one nonlinear solve per step.";
      facts.reference = "Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, doi:10.1007/978-3-540-78862-1, III.5";
      facts.order     = 2;
      facts.stability = "L-stable";
      facts.error_exponent = 3;
      return facts;
    }

    /// With r the ratio of this step to the last one and D x = (1 + 2r)/(1 + r) (x_1 - x_0) - r^2/(1 + r) (x_0 - x_-1):
    /// dt v_1 = D u, dt a_1 = D v, R(t_1, u_1, v_1, a_1) = 0. The first step of a smooth piece is one of a one-step method.
    ///
    /// With y = (u, v) the error of a step is (1 + r)^2/(6 r (1 + 2r)) dt^3 y''' + O(dt^4), estimated with the second divided difference
    /// of y' = (v, a) at the last three ends of steps.
    class Bdf2 : public Integrator
    {
    public:
      Bdf2(const DirkTable &starter, const IntegratorContext &context)
        : has_accelerations_(context.error_norm != nullptr && has_accelerations(context.system))
        , context_(context)
        , solver_(context)
        , starter_(starter, solver_, context)
        , before_(context.make_state())
        , last_(before_)
        , end_(before_)
        , error_(before_)
      {}

      void start(State &state) override
      {
        start_piece(context_, solver_, state);
        if (has_accelerations_) // of which the estimate needs the first one, too
          consistent_acceleration(context_, solver_, Side::right, state);
        last_dt_ = 0;
      }

      StepReport step(const double dt, State &state) override
      {
        combine(before_.u, {{1, &state.u}});
        combine(before_.v, {{1, &state.v}});
        combine(before_.a, {{1, &state.a}});
        StepReport report = last_dt_ == 0 ? starter_.step(dt, state) : go_on(dt, state);
        if (!report.accepted())
          return report;
        combine(last_.u, {{1, &state.u}, {-1, &before_.u}});
        combine(last_.v, {{1, &state.v}, {-1, &before_.v}});
        combine(last_.a, {{1, &state.a}, {-1, &before_.a}});
        last_dt_ = dt;
        return report;
      }

      void remember(Memory &memory) override
      {
        memory.keep("last step", last_dt_);
        if (last_dt_ == 0)
          return;
        memory.keep("last increment of u", last_.u);
        memory.keep("last increment of v", last_.v);
        bool known = estimates();
        memory.keep("last increment of a is known", known);
        if (known && estimates())
          memory.keep("last increment of a", last_.a);
        else if (estimates())
          last_dt_ = 0; // the run to resume made no estimates: begin anew
      }

    private:
      StepReport go_on(const double dt, State &state)
      {
        const double ratio = dt / last_dt_;
        const double c = (1 + 2 * ratio) / ((1 + ratio) * dt), memory = ratio * ratio / (1 + 2 * ratio);
        Stage        stage;
        stage.t = state.t + dt;
        stage.c = {1, c, c * c};
        // c (u_1 - u^) = v_1, c (v_1 - v^) = a_1 with u^ = u_0 + memory du, v^ = v_0 + memory dv
        combine(end_.v, {{1, &state.v}, {memory, &last_.v}});
        combine(end_.u, {{1, &state.u}, {memory, &last_.u}, {1 / c, &end_.v}});
        end_.a = 0;
        StepReport report;
        record(solver_.solve(stage, end_, state), report);
        if (report.accepted() && estimates())
          estimate(dt, state, report);
        if (report.accepted())
          swap(state, end_);
        return report;
      }

      bool estimates() const { return context_.error_norm != nullptr; }

      void estimate(const double dt, const State &state, StepReport &report)
      {
        const double r = dt / last_dt_, factor = (1 + r) / (3 * (1 + 2 * r)) * dt;
        combine(error_.u, {{factor, &end_.v}, {-factor, &state.v}, {-factor * r, &last_.v}});
        combine(error_.v, {{factor, &end_.a}, {-factor, &state.a}, {-factor * r, &last_.a}});
        record_estimate(solver_.damp(error_), report);
        if (report.accepted())
          ErrorNorm::judge(context_.error_norm->of_step(error_.u, &error_.v, state, end_), report);
      }

      const bool              has_accelerations_;
      const IntegratorContext context_;
      StageSolver             solver_;
      DirkStepper             starter_;
      double                  last_dt_ = 0; ///< 0: nothing is remembered
      State                   before_;      ///< the last step
      State                   last_;        ///< increments of u, v, a in it
      State                   end_, error_;
    };
  } // namespace

  IntegratorEntry bdf2_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.schema.choice("first step", "sdirk2", {"sdirk2", "backward euler"},
                        "Method of the first step of every smooth piece; backward euler leaves an error of second order of its own.");
    entry.make = [](const scene::Node &node, const IntegratorContext &context) -> std::unique_ptr<Integrator> {
      if (context.error_norm != nullptr && node.text("first step") != "sdirk2")
        node.refuse("first step", "is \"" + node.text("first step") + "\", which does not estimate its error", "\"sdirk2\"");
      return std::make_unique<Bdf2>(node.text("first step") == "sdirk2" ? sdirk2_table() : DirkTable{{{1}}}, context);
    };
    return entry;
  }
} // namespace myolines
