// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/dirk_tables.h>
#include <myolines/time/first_step.h>
#include <myolines/time/start.h>

namespace myolines
{
  Starter::Starter(const FirstStep kind, StageSolver &solver, const IntegratorContext &context, const unsigned int order,
                   const unsigned int steps)
    : context_(context)
    , solver_(solver)
    , passes_(order < 4 ? 1 : 2)
    , steps_(steps)
  {
    if (kind == FirstStep::l_stable)
      stepper_.emplace(order <= 2 ? sdirk2_table() : sdirk3_table(), solver, context);
  }

  void Starter::start(State &state)
  {
    start_piece(context_, solver_, state);
    due_ = stepper_ ? steps_ : 0;
    if (!stepper_)
      consistent_acceleration(context_, solver_, Side::right, state);
  }

  StepReport Starter::step(const double dt, State &state)
  {
    StepReport report = stepper_->step(dt, state);
    if (!report.accepted())
      return report;
    --due_;
    resolve_acceleration(state, report);
    return report;
  }

  void Starter::resolve_acceleration(State &state, StepReport &report)
  {
    const State &first = stepper_->stage(0);
    const double h     = state.t - first.t;
    Vector       gap(state.a), closed(state.a); // a - q, and what of it is kept
    combine(gap, {{1, &state.a}, {-1 / h, &state.v}, {1 / h, &first.v}});
    closed = 0;
    for (unsigned int pass = 0; pass < passes_; ++pass)
      {
        State rest{state.t, state.u, state.v, state.a};
        rest.u = 0;
        combine(rest.v, {{1, &gap}, {-1, &closed}});
        const NonlinearReport solve = solver_.damp(rest);
        report.newton_iterations += solve.iterations;
        report.linear_iterations += solve.linear_iterations;
        if (solve.converged)
          combine(closed, {{1, &closed}, {1, &rest.v}});
      }
    combine(state.a, {{1 / h, &state.v}, {-1 / h, &first.v}, {1, &closed}});
    state.a.update_ghost_values();
    if (context_.boundary_rates == BoundaryRates::exact)
      context_.system.prescribed(state.t, Side::left, state);
  }

  void Starter::remember(Memory &memory) { memory.keep("first steps of a piece that are due", due_); }

  void declare_first_step(scene::Schema &schema)
  {
    schema.choice("first step", "l-stable", {"l-stable", "own"},
                  "First step of every smooth piece (start of the run, restarts at kinks): one of Alexander's L-stable methods, "
                  "which needs no acceleration and damps what the step does not resolve, or by the formulas of this method, from the "
                  "acceleration M a = -F.");
  }

  void require_fitting_first_step(const MethodFacts &facts, const scene::Node &integrator, const IntegratorContext &context)
  {
    if (const std::string why = why_no_accelerations(context.system); !why.empty() && first_step(integrator) == FirstStep::own)
      integrator.refuse("first step", "is \"own\", with which \"" + facts.name + "\" begins from accelerations, but " + why,
                        "\"l-stable\"");
  }

  FirstStep first_step(const scene::Node &integrator)
  {
    return integrator.text("first step") == "own" ? FirstStep::own : FirstStep::l_stable;
  }
} // namespace myolines
