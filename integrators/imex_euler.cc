// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/time/combination.h>
#include <myolines/time/stable_step.h>
#include <myolines/time/start.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    constexpr const char *tangent_split = "tangent at the start of the step";

    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name    = "imex euler";
      facts.summary = "Euler's method, implicit for one part of the forces and explicit for the rest: one solve per step.";
      facts.reference =
          "thesis (4.7.9); Ascher, Ruuth and Spiteri, doi:10.1016/S0168-9274(97)00056-1; with the tangent: Hairer and Wanner, "
          "doi:10.1007/978-3-642-05221-7, IV.7";
      facts.order     = 1;
      facts.stability = "L-stable for linear systems with the tangent, else dt^2 (k_E - k_I) + 2 dt (c_E - c_I) <= 4";
      facts.unknowns  = MethodFacts::Unknowns::second_order;
      facts.solves    = MethodFacts::Solves::linear_systems;
      return facts;
    }

    void update_ghosts(State &state)
    {
      for (Vector *x : {&state.u, &state.v, &state.a})
        x->update_ghost_values();
    }

    /// The residual at the end of a step, which explicit forces have not seen: is it admissible?
    void look_at(const State &end, const SemiDiscreteSystem &system, Vector &r, StepReport &report)
    {
      record(system.residual({end.t, Side::left, end.u, end.v, end.a}, r), report);
    }

    /// R = R_I + F_E with R_I, which holds M a, of a named split:
    ///
    ///     u_1 = u_0 + dt v_1,   v_1 = v_0 + dt a_1,   R_I(t_1, u_1, v_1, a_1) + F_E(t_0, u_0, v_0) = 0.
    ///
    /// Of the rod and its split `linear` this is thesis (4.7.9): u and v are those of (4.7.9a, b), and a_1 = (v_1 - v_0)/dt.
    ///
    /// For modes that both parts share, a + (c_I + c_E) v + (k_I + k_E) u = 0, it is stable for dt^2 (k_E - k_I) + 2 dt (c_E - c_I) <= 4
    /// (then an eigenvalue is -1); of the rod that is dt <= 2/sqrt(kappa_max (F_1' - mu)/rho). The step is not compared with it in advance,
    /// as it is that of small motions; a step that fails says what it is.
    class AdditiveEuler : public Integrator
    {
    public:
      AdditiveEuler(const std::string &split, std::unique_ptr<SemiDiscreteSystem> part, const IntegratorContext &context)
        : split_(split)
        , part_(std::move(part))
        , whole_(context.system)
        , context_{*part_, context.solver, context.boundary_rates, context.ledger, context.start_velocity, context.error_norm}
        , linear_(part_->capabilities().linear)
        , solver_(context_)
        , r_(context.make_vector())
        , r_part_(r_)
        , zero_(r_)
        , end_(context.make_state())
      {}

      void start(State &state) override { start_piece(context_, solver_, state); }

      StepReport step(const double dt, State &state) override
      {
        StepReport report;
        explicit_force(state, report);
        if (report.accepted())
          solve(dt, state, report);
        if (linear_)
          report.initial_residual = report.final_residual = std::nullopt; // nobody looks at what is left of the equations
        if (report.accepted())
          look_at(end_, whole_, r_, report);
        if (report.accepted())
          swap(state, end_);
        else
          explain(state.t, report);
        return report;
      }

    private:
      /// r_ = F_E(t_0, u_0, v_0), in which M a cancels.
      void explicit_force(const State &state, StepReport &report)
      {
        const Point at{state.t, Side::right, state.u, state.v, zero_};
        record(whole_.residual(at, r_), report);
        if (report.accepted())
          record(part_->residual(at, r_part_), report);
        combine(r_, {{1, &r_}, {-1, &r_part_}});
      }

      /// As backward Euler, with d = u_1 - u~.
      void solve(const double dt, const State &state, StepReport &report)
      {
        combine(end_.u, {{1, &state.u}, {dt, &state.v}});
        combine(end_.v, {{1, &state.v}});
        end_.a = 0;
        Stage stage;
        stage.t       = state.t + dt;
        stage.c       = {1, 1 / dt, 1 / (dt * dt)};
        stage.history = &r_;
        record(solver_.solve(stage, end_, state), report);
        end_.t = stage.t;
      }

      /// Adds the limit of the step at rest to the reason, from the largest eigenvalues of M^-1 (K_E - K_I) and M^-1 (C_E - C_I).
      void explain(const double t, StepReport &report)
      {
        const Point rest{t, Side::right, zero_, zero_, zero_};
        const auto  tangent = whole_.make_linearisation();
        StepReport  estimate;
        context_.ledger.count("stable step estimates");
        whole_.linearise(rest, *tangent);
        solver_.linearise(rest);
        Vector     of_part(zero_);
        const auto of = [&](const Weights &w) {
          const auto action = [&](const Vector &x, Vector &y) {
            tangent->apply(stage_weights(w.u, w.v, w.a), x, y);
            solver_.apply(w, x, of_part);
            combine(y, {{1, &y}, {-2, &of_part}});
          };
          return std::max(0., largest_eigenvalue(action, whole_, solver_, zero_, estimate));
        };
        const double stiffness = of({1, 0, 0});
        const double rates     = estimate.accepted() && whole_.capabilities().rates ? of({0, 1, 0}) : 0;
        context_.solver.forget();
        report.newton_iterations += estimate.newton_iterations;
        report.linear_iterations += estimate.linear_iterations;
        report.residual_evaluations += estimate.residual_evaluations;
        if (!estimate.accepted() || stiffness + rates == 0)
          return;
        std::ostringstream text;
        text.precision(4);
        text << report.reason << "; the explicit part of the split \"" << split_ << "\" limits the step to about "
             << 4 / (rates + std::sqrt(rates * rates + 4 * stiffness)) << " s (estimated for small motions about rest)";
        report.reason = text.str();
      }

      const std::string                         split_;
      const std::unique_ptr<SemiDiscreteSystem> part_;
      const SemiDiscreteSystem                 &whole_;
      const IntegratorContext                   context_; ///< of the implicit part
      const bool                                linear_;
      StageSolver                               solver_;
      Vector                                    r_, r_part_, zero_;
      State                                     end_;
    };

    /// R_I = M a + K (u - u_0) + C (v - v_0) with the tangents at t_0, u_0, v_0, and so F_E = R(t_0, u_0, v_0, 0):
    ///
    ///     u_1 = u_0 + dt v_1,   v_1 = v_0 + dt a_1,   (M + dt C + dt^2 K) a_1 = -R(t_0, u_0, v_0, 0) - dt K v_0.
    class TangentEuler : public Integrator
    {
    public:
      explicit TangentEuler(const IntegratorContext &context)
        : context_(context)
        , rates_(context.system.capabilities().rates)
        , solver_(context)
        , r_(context.make_vector())
        , product_(r_)
        , d_(r_)
        , end_(context.make_state())
        , exact_(end_)
      {}

      void start(State &state) override { start_piece(context_, solver_, state); }

      StepReport step(const double dt, State &state) override
      {
        StepReport report;
        predict(dt, state);
        solve(dt, state, report);
        report.initial_residual = report.final_residual = std::nullopt; // nobody looks at what is left of the equations
        if (report.accepted())
          look_at(end_, context_.system, product_, report);
        if (report.accepted())
          swap(state, end_);
        return report;
      }

    private:
      /// end_ = (u_0 + dt v_0, v_0, 0), but for constrained unknowns, which are at their ends already.
      void predict(const double dt, const State &state)
      {
        end_.t = state.t + dt;
        combine(end_.u, {{1, &state.u}, {dt, &state.v}});
        combine(end_.v, {{1, &state.v}});
        end_.a = 0;
        if (context_.boundary_rates == BoundaryRates::exact)
          {
            context_.system.prescribed(end_.t, Side::left, end_);
            return;
          }
        exact_ = end_;
        context_.system.prescribed(end_.t, Side::left, exact_);
        for (unsigned int i = 0; i < end_.u.locally_owned_size(); ++i)
          if (context_.system.constraints().is_constrained(end_.u.get_partitioner()->local_to_global(i)))
            {
              end_.u.local_element(i) = exact_.u.local_element(i);
              end_.v.local_element(i) = (end_.u.local_element(i) - state.u.local_element(i)) / dt;
              end_.a.local_element(i) = (end_.v.local_element(i) - state.v.local_element(i)) / dt;
            }
        update_ghosts(end_);
      }

      /// With d on top of what is predicted: r_ = R_I + F_E there, (M + dt C + dt^2 K) d = -r_.
      void solve(const double dt, const State &state, StepReport &report)
      {
        const Point      at{state.t, Side::right, state.u, state.v, end_.a};
        const Evaluation evaluation = context_.system.residual(at, r_);
        record(evaluation, report);
        if (!report.accepted())
          return;
        solver_.linearise(at);
        combine(d_, {{1, &end_.u}, {-1, &state.u}});
        solver_.apply({1, 0, 0}, d_, product_);
        combine(r_, {{1, &r_}, {1, &product_}});
        if (rates_)
          {
            combine(d_, {{1, &end_.v}, {-1, &state.v}});
            solver_.apply({0, 1, 0}, d_, product_);
            combine(r_, {{1, &r_}, {1, &product_}});
          }
        d_ = 0;
        record(solver_.solve_linear({dt * dt, dt, 1}, r_, d_, false, evaluation.rounding), report);
        combine(end_.u, {{1, &end_.u}, {dt * dt, &d_}});
        combine(end_.v, {{1, &end_.v}, {dt, &d_}});
        combine(end_.a, {{1, &end_.a}, {1, &d_}});
        update_ghosts(end_);
      }

      const IntegratorContext context_;
      const bool              rates_;
      StageSolver             solver_;
      Vector                  r_, product_, d_;
      State                   end_, exact_;
    };

    std::unique_ptr<Integrator> make(const scene::Node &node, const IntegratorContext &context)
    {
      const std::string name = node.text("split");
      if (name == tangent_split)
        return std::make_unique<TangentEuler>(context);
      std::vector<std::string> names{tangent_split};
      for (const Split &split : context.system.capabilities().splits)
        {
          if (split.name == name && !split.refused.empty() && !node.boolean("force"))
            node.refuse("split", "the split \"" + name + "\" is refused: " + split.refused, std::string("\"") + tangent_split + "\"",
                        "with \"force\" = \"true\" it is run all the same");
          if (split.name == name)
            return std::make_unique<AdditiveEuler>(name, context.system.implicit_part(name), context);
          names.push_back(split.name);
        }
      const std::string nearest = nearest_name(name, names);
      node.refuse("split", "this system has no split \"" + name + "\"", "one of " + join(names),
                  nearest.empty() ? "" : "nearest valid name: \"" + nearest + "\"");
    }

    /// What splits are there belongs to the system: see Capabilities::splits.
    scene::Schema schema()
    {
      scene::Schema schema(facts().summary);
      schema
          .text("split", tangent_split,
                "What is implicit: the tangent at the start of the step (of any system; one linear solve), linear (rod: thesis (4.7.9); "
                "oscillator: all but the cubic spring; muscle: passive stiffness at rest), or of the muscle volumetric, passive, all but "
                "active (by Newton's method).")
          .boolean("force", false,
                   "Whether to run a split that the system refuses: one whose explicit part allows no step of practical use.");
      return schema;
    }
  } // namespace

  IntegratorEntry imex_euler_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = schema();
    entry.make   = make;
    return entry;
  }
} // namespace myolines
