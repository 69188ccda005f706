// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/solve/free_unknowns.h>
#include <myolines/time/combination.h>
#include <myolines/time/start.h>

#include <algorithm>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// Zeros in the constrained entries (@p constrained) or in the free ones.
    void clear(const SemiDiscreteSystem &system, Vector &x, const bool constrained)
    {
      x.zero_out_ghost_values();
      const Constraints &constraints = system.constraints();
      for (const auto index : x.locally_owned_elements())
        if (constraints.is_constrained(index) == constrained)
          x(index) = 0;
      x.update_ghost_values();
    }

    /// M x = r for the free unknowns, with the constrained ones of @p x given: as a stage whose unknown is the acceleration.
    void solve_mass(const IntegratorContext &context, StageSolver &solver, const Side side, const Vector *history, State &point,
                    const std::string &what)
    {
      Stage stage;
      stage.t          = point.t;
      stage.side       = side;
      stage.c          = {0, 0, 1};
      stage.history    = history;
      stage.prescribed = false;
      Vector d(point.a);
      d                            = 0;
      const NonlinearReport report = solver.solve(stage, point, d);
      context.solver.forget(); // the weights of the steps to come are others
      if (!report.converged)
        throw SolveError("The " + what + " cannot be computed: " + report.reason + ".");
    }

    /// dv = (velocities after the jump of the boundary) - (before), M_ff dv_f = -M_fc dv_c; on entry dv_f = 0.
    void add_impulse(const IntegratorContext &context, StageSolver &solver, const Vector &jump, State &state)
    {
      State  point{state.t, state.u, state.v, jump};
      Vector others(state.u); // R without M a, to be taken away
      Vector zero(state.u);
      zero = 0;
      zero.update_ghost_values();
      const Evaluation evaluation = context.system.residual({state.t, Side::right, state.u, state.v, zero}, others);
      if (!evaluation.admissible)
        throw SolveError("The impulse of the moving boundary cannot be computed: " + evaluation.reason + ".");
      others *= -1;
      solve_mass(context, solver, Side::right, &others, point, "impulse of the moving boundary");
      clear(context.system, point.a, true);
      combine(state.v, {{1, &state.v}, {1, &point.a}});
      context.system.prescribed(state.t, Side::right, state); // velocities that depend on the others
    }
  } // namespace

  Vector IntegratorContext::make_vector() const
  {
    Vector zeros = system.initial_state(0).u;
    zeros        = 0;
    zeros.update_ghost_values();
    return zeros;
  }

  State IntegratorContext::make_state() const
  {
    const Vector zeros = make_vector();
    return {0, zeros, zeros, zeros};
  }

  State starting_state(const SemiDiscreteSystem &system, const double t0, const BoundaryRates rates, const StartVelocity start_velocity)
  {
    State state = system.initial_state(t0);
    if (start_velocity == StartVelocity::consistent)
      return state;
    clear(system, state.v, true);
    if (rates == BoundaryRates::scheme)
      clear(system, state.a, true);
    return state;
  }

  NonlinearReport raise_loads(const IntegratorContext &context, StageSolver &solver, Stage stage, double part, State &rest)
  {
    NonlinearReport  total;
    Vector           unloaded(rest.u), history(rest.u);
    const Evaluation evaluation = context.system.residual({stage.t, stage.side, rest.u, rest.v, rest.a}, unloaded);
    if (!evaluation.admissible)
      {
        total.reason       = evaluation.reason;
        total.inadmissible = true;
        return total;
      }
    constexpr double smallest = 1. / 1024;
    double           done     = 0;
    while (done < 1)
      {
        const double next = std::min(1., done + part);
        stage.history     = next < 1 ? &history : nullptr;
        combine(history, {{next - 1, &unloaded}});
        State  point = rest;
        Vector d(rest.u);
        d = 0;
        context.ledger.count("load steps");
        const NonlinearReport report    = solver.solve(stage, point, d);
        const double          first     = total.iterations == 0 ? report.initial_residual : total.initial_residual;
        const unsigned int    before[3] = {total.iterations, total.linear_iterations, total.residual_evaluations};
        total                           = report;
        total.initial_residual          = first;
        total.iterations += before[0];
        total.linear_iterations += before[1];
        total.residual_evaluations += before[2];
        if (report.converged)
          {
            done = next;
            part *= 2;
            swap(rest, point);
          }
        else if ((part /= 2) < smallest)
          {
            std::ostringstream text;
            text << "at " << next << " of the loads, " << report.reason;
            total.reason = text.str();
            return total;
          }
      }
    return total;
  }

  void start_from_equilibrium(const IntegratorContext &given, State &state)
  {
    // With the rates of the boundary the body would be strained and accelerated there: they are left at zero.
    const IntegratorContext context{given.system, given.solver, BoundaryRates::scheme, given.ledger};
    StageSolver             solver(context);
    context.ledger.count("starts from equilibrium");
    State rest = state;
    for (Vector *x : {&rest.u, &rest.v, &rest.a})
      {
        *x = 0;
        x->update_ghost_values();
      }
    Stage stage;
    stage.t                      = state.t;
    stage.side                   = Side::right;
    stage.c                      = {1, 0, 0};
    const NonlinearReport report = raise_loads(context, solver, stage, 1, rest);
    if (!report.converged)
      throw SolveError("The equilibrium to start from cannot be computed: " + report.reason +
                       ". To try: " + (report.advice.empty() ? "" : report.advice + ", or ") +
                       "smaller loads or another activation at the start: equilibria may end there (a limit point).");
    context.solver.forget(); // the weights of the steps to come are others
    state.u.swap(rest.u);
  }

  void start_piece(const IntegratorContext &context, StageSolver &solver, State &state)
  {
    const bool impulse = context.start_velocity == StartVelocity::impulse;
    if (impulse && context.boundary_rates == BoundaryRates::scheme)
      return;
    Vector jump(state.v);
    context.system.prescribed(state.t, Side::right, state);
    combine(jump, {{1, &state.v}, {-1, &jump}});
    jump.update_ghost_values();
    if (impulse && context.system.capabilities().inertia && jump.linfty_norm() > 0)
      add_impulse(context, solver, jump, state);
  }

  void consistent_acceleration(const IntegratorContext &context, StageSolver &solver, const Side side, State &state)
  {
    State point = state;
    // What constrained accelerations owe to the free ones comes with the solution.
    Vector owed(state.a);
    FreeUnknowns(context.system.constraints(), state.a).distribute(owed);
    clear(context.system, owed, false);
    clear(context.system, point.a, false);
    combine(point.a, {{1, &point.a}, {-1, &owed}});
    point.a.update_ghost_values();
    solve_mass(context, solver, side, nullptr, point, "initial acceleration");
    state.a.swap(point.a);
  }

  bool has_accelerations(const SemiDiscreteSystem &system) { return why_no_accelerations(system).empty(); }

  std::string why_no_accelerations(const SemiDiscreteSystem &system)
  {
    const Capabilities capabilities = system.capabilities();
    if (!capabilities.inertia)
      return "the system has no inertia";
    return capabilities.orders == std::vector<unsigned int>{2} ? "" : "not all unknowns of the system are of second order in time";
  }

  void require_fit(const MethodFacts &facts, const scene::Node &integrator, const IntegratorContext &context)
  {
    using Unknowns         = MethodFacts::Unknowns;
    const bool first_order = context.system.capabilities().orders == std::vector<unsigned int>{1};
    const bool needs = facts.unknowns == Unknowns::second_order || (facts.unknowns == Unknowns::first_or_second_order && !first_order);
    if (const std::string why = why_no_accelerations(context.system); needs && !why.empty())
      integrator.refuse("type", "\"" + facts.name + "\" needs the acceleration of every unknown, but " + why,
                        "a method that does without, or another system", methods_hint);
    const Capabilities capabilities = context.system.capabilities();
    if (facts.two_states && !capabilities.two_states && !capabilities.linear)
      integrator.refuse("type", "\"" + facts.name + "\" needs the force of two states, which the system does not have",
                        "a method that does without, or another system", methods_hint);
    if (!facts.scheme_rates && context.boundary_rates == BoundaryRates::scheme && context.system.constraints().n_constraints() > 0)
      integrator.refuse("type", "\"" + facts.name + "\" has no formulas of its own for the rates of a moving boundary",
                        "\"time/boundary rates\" = \"exact\"");
  }

  void refuse_scheme_rates(const scene::Node &integrator, const IntegratorContext &context)
  {
    if (context.boundary_rates == BoundaryRates::scheme && context.system.constraints().n_constraints() > 0)
      integrator.refuse("type",
                        "with these parameters the velocity of a moving boundary grows without bound under \"boundary rates\" = "
                        "\"scheme\"",
                        "\"time/boundary rates\" = \"exact\"",
                        "or a method that is unconditionally stable: a prescribed motion acts like an infinitely stiff spring");
  }
} // namespace myolines
