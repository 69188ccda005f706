// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/start.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name = "static";
      facts.summary =
          "A sequence of equilibria: inertia and rates are left out, loads and boundaries follow the time; boundary rates play no part.";
      facts.reference = "thesis (5.4.2), remark 5.6: V = 0 throughout";
      facts.order     = 0;
      facts.stability = "no dynamics";
      facts.dynamic   = false;
      return facts;
    }

    /// R(t_1, u_1, 0, 0) = 0; v and a stay zero, also on moving boundaries, so that no rate term is met. Where no boundary moves and one
    /// solve is too much, the loads are raised in parts: shorter steps would not help where they do not depend on time.
    class Static : public Integrator
    {
    public:
      explicit Static(const IntegratorContext &context)
        : context_(at_rest(context))
        , solver_(context_)
      {}

      void start(State &state) override
      {
        state.v = 0;
        state.a = 0;
      }

      StepReport step(const double dt, State &state) override
      {
        Stage stage;
        stage.t = state.t + dt;
        stage.c = {1, 0, 0};

        State      rest   = at_rest(state);
        StepReport report = solver_.step(stage, rest, state);
        if (report.accepted() || !report.shorter_steps)
          return report;
        const bool moved = moves(stage, state);
        if (!moved)
          {
            const std::string reason = report.reason;
            rest                     = at_rest(state);
            record(raise_loads(context_, solver_, stage, 0.5, rest), report);
            if (report.accepted())
              swap(state, rest);
            else
              report.reason = reason + "; raised in parts, " + report.reason;
          }
        if (!report.accepted())
          advise(moved || depends_on_time(stage, state), report);
        return report;
      }

    private:
      static IntegratorContext at_rest(IntegratorContext context)
      {
        context.boundary_rates = BoundaryRates::scheme; // the "scheme" of this method is v = a = 0
        return context;
      }

      static State at_rest(State state)
      {
        state.v = 0;
        state.a = 0;
        return state;
      }

      static void advise(const bool depends_on_time, StepReport &report)
      {
        report.shorter_steps = report.shorter_steps && depends_on_time;
        report.advice += (report.advice.empty() ? "" : ", or ") +
                         std::string("smaller loads: equilibria may end there (a limit point), beyond which only a dynamic system goes on");
      }

      /// Whether loads do.
      bool depends_on_time(const Stage &stage, const State &state) const
      {
        const State rest = at_rest(state);
        Vector      before(state.u), after(state.u);
        context_.system.residual({state.t, Side::right, rest.u, rest.v, rest.a}, before);
        context_.system.residual({stage.t, stage.side, rest.u, rest.v, rest.a}, after);
        after -= before;
        return after.linfty_norm() > 0;
      }

      bool moves(const Stage &stage, const State &state) const
      {
        State there = state;
        context_.system.prescribed(stage.t, stage.side, there);
        there.u -= state.u;
        return there.u.linfty_norm() > 0;
      }

      const IntegratorContext context_;
      StageSolver             solver_;
    };
  } // namespace

  IntegratorEntry static_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.make   = [](const scene::Node &, const IntegratorContext &context) { return std::make_unique<Static>(context); };
    return entry;
  }
} // namespace myolines
