// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/start.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name = "rosenbrock";
      facts.summary =
          "Linearly implicit method of two stages and second order: two linear solves per step with one Jacobian, no iteration.";
      facts.reference = "Shampine and Reichelt, The MATLAB ODE suite (ode23s), doi:10.1137/S1064827594276424";
      facts.order     = 2;
      facts.stability = "L-stable for linear systems";
      facts.unknowns  = MethodFacts::Unknowns::second_order;
      facts.solves    = MethodFacts::Solves::linear_systems;
      return facts;
    }

    constexpr double d = 0.29289321881345247560; // 1/(2 + sqrt(2))

    /// For y = (u, v) with y' = (v, M^-1 (-F)): W = 1 - h d dy'/dy at the beginning of the step and
    ///
    ///     W k_1 = y'(t_0 + d h, y_0),   W (k_2 - k_1) = y'(t_0 + h/2, y_0 + h/2 k_1) - k_1,   y_1 = y_0 + h k_2.
    ///
    /// The first line evaluates at t_0 + d h what the authors write as h d dy'/dt. The rows of u give k_u from k_v, and
    /// both stages become one linear system with the matrix M + h d C + (h d)^2 K. The order does not depend on the Jacobian.
    ///
    /// The acceleration at the end, which the method does not need, is k_1v and k_2v extrapolated from t_0 + d h and t_0 + h/2.
    class Rosenbrock : public Integrator
    {
    public:
      explicit Rosenbrock(const IntegratorContext &context)
        : context_(context)
        , solver_(context)
        , exact_rates_(context.boundary_rates == BoundaryRates::exact)
        , constrained_(constrained_unknowns(context))
        , k1_c_(constrained_.size())
        , k2_c_(constrained_.size())
        , r_(context.make_vector())
        , k1_(r_)
        , change_(r_)
        , work_(r_)
        , zero_(r_)
        , middle_(context.make_state())
        , end_(middle_)
      {}

      void start(State &state) override
      {
        start_piece(context_, solver_, state);
        consistent_acceleration(context_, solver_, Side::right, state);
      }

      StepReport step(const double h, State &state) override
      {
        prescribe(h, state);
        StepReport report;
        if (first_stage(h, state, report) && second_stage(h, state, report))
          finish(h, state, report);
        report.initial_residual = report.final_residual = std::nullopt; // nobody looks at what is left of the equations
        if (report.outcome == StepReport::Outcome::inadmissible)
          report.advice =
              "a smaller \"time/step\" from the start, as no step mends what linear ones before it have spoiled; or a method that "
              "iterates";
        return report;
      }

    private:
      /// Local numbers.
      static std::vector<unsigned int> constrained_unknowns(const IntegratorContext &context)
      {
        const Vector              layout = context.make_vector();
        std::vector<unsigned int> all;
        for (unsigned int i = 0; i < layout.locally_owned_size(); ++i)
          if (context.system.constraints().is_constrained(layout.get_partitioner()->local_to_global(i)))
            all.push_back(i);
        return all;
      }

      /// k_1v and k_2v of constrained unknowns: the derivatives of their motion, or what makes the formulas of u meet g at
      /// t_0 + h/2 and t_0 + h.
      void prescribe(const double h, const State &state)
      {
        State &at = middle_; // free unknowns at zero: what constrained ones take from them the solver adds
        for (Vector *x : {&at.u, &at.v, &at.a})
          *x = 0;
        if (exact_rates_)
          {
            std::vector<double> before;
            context_.system.prescribed(state.t, Side::right, at);
            take(at.v, before);
            context_.system.prescribed(state.t + d * h, Side::left, at);
            take(at.a, k1_c_);
            context_.system.prescribed(state.t + h, Side::left, at);
            for (std::size_t i = 0; i < constrained_.size(); ++i)
              k2_c_[i] = (at.v.local_element(constrained_[i]) - before[i]) / h;
            return;
          }
        std::vector<double> half(constrained_.size()), whole(constrained_.size());
        context_.system.prescribed(state.t + h / 2, Side::left, at);
        take(at.u, half);
        context_.system.prescribed(state.t + h, Side::left, at);
        take(at.u, whole);
        for (std::size_t i = 0; i < constrained_.size(); ++i)
          {
            const double u = state.u.local_element(constrained_[i]), v = state.v.local_element(constrained_[i]);
            k1_c_[i] = ((half[i] - u) * 2 / h - v) / (h * d);
            k2_c_[i] = ((whole[i] - u) / h - v - h * (0.5 - d) * k1_c_[i]) / (h * d);
          }
      }

      /// (M + h d C + (h d)^2 K) k_1v = -F(t_0 + d h, u_0, v_0) - h d K v_0
      bool first_stage(const double h, const State &state, StepReport &report)
      {
        const Point at{state.t + d * h, Side::left, state.u, state.v, zero_};
        evaluate(at, report);
        if (!report.accepted())
          return false;
        solver_.linearise(at);
        solver_.apply({1, 0, 0}, state.v, work_);
        combine(r_, {{1, &r_}, {h * d, &work_}});
        k1_ = 0;
        for (std::size_t i = 0; i < constrained_.size(); ++i)
          k1_.local_element(constrained_[i]) = k1_c_[i];
        record(solver_.solve_linear(matrix(h), r_, k1_, false, rounding_), report);
        return report.accepted();
      }

      /// The same matrix for k_2v - k_1v, with R(t_0 + h/2, u_0 + h/2 k_1u, v_0 + h/2 k_1v, k_1v) + h^2 d (1/2 - d) K k_1v.
      bool second_stage(const double h, const State &state, StepReport &report)
      {
        combine(middle_.u, {{1, &state.u}, {h / 2, &state.v}, {h * h * d / 2, &k1_}});
        combine(middle_.v, {{1, &state.v}, {h / 2, &k1_}});
        combine(middle_.a, {{1, &k1_}});
        keep_rates(state.t + h / 2, middle_);
        combine(middle_.a, {{1, &k1_}});
        middle_.a.update_ghost_values();
        evaluate({state.t + h / 2, Side::left, middle_.u, middle_.v, middle_.a}, report);
        if (!report.accepted())
          return false;
        solver_.apply({1, 0, 0}, k1_, work_);
        combine(r_, {{1, &r_}, {h * h * d * (0.5 - d), &work_}});
        change_ = 0;
        for (std::size_t i = 0; i < constrained_.size(); ++i)
          change_.local_element(constrained_[i]) = k2_c_[i] - k1_c_[i];
        record(solver_.solve_linear(matrix(h), r_, change_, false, rounding_), report);
        return report.accepted();
      }

      /// What was only extrapolated may be inadmissible: the end is looked at before it is accepted.
      void finish(const double h, State &state, StepReport &report)
      {
        combine(end_.u, {{1, &state.u}, {h, &state.v}, {h * h / 2, &k1_}, {h * h * d, &change_}});
        combine(end_.v, {{1, &state.v}, {h, &k1_}, {h, &change_}});
        combine(end_.a, {{1, &k1_}, {1 + 0.5 / (0.5 - d), &change_}});
        keep_rates(state.t + h, end_);
        end_.t = state.t + h;
        evaluate({end_.t, Side::left, end_.u, end_.v, end_.a}, report);
        if (report.accepted())
          swap(state, end_);
      }

      /// Constrained displacements are g(t); rates too if they are exact, else they stay as the formulas made them.
      void keep_rates(const double t, State &state)
      {
        if (!exact_rates_)
          {
            take(state.v, k1_v_);
            take(state.a, k1_a_);
          }
        context_.system.prescribed(t, Side::left, state);
        if (!exact_rates_)
          for (std::size_t i = 0; i < constrained_.size(); ++i)
            {
              state.v.local_element(constrained_[i]) = k1_v_[i];
              state.a.local_element(constrained_[i]) = k1_a_[i];
            }
        for (Vector *x : {&state.u, &state.v, &state.a})
          x->update_ghost_values();
      }

      void take(const Vector &x, std::vector<double> &entries) const
      {
        entries.resize(constrained_.size());
        for (std::size_t i = 0; i < constrained_.size(); ++i)
          entries[i] = x.local_element(constrained_[i]);
      }

      /// r_ = R(point).
      void evaluate(const Point &point, StepReport &report)
      {
        const Evaluation evaluation = context_.system.residual(point, r_);
        rounding_                   = evaluation.rounding;
        record(evaluation, report);
      }

      static Weights matrix(const double h) { return {h * d * h * d, h * d, 1}; }

      const IntegratorContext         context_;
      StageSolver                     solver_;
      const bool                      exact_rates_;
      const std::vector<unsigned int> constrained_;
      std::vector<double>             k1_c_, k2_c_, k1_v_, k1_a_;
      Vector                          r_, k1_, change_, work_, zero_;
      double                          rounding_ = 0; ///< of r_
      State                           middle_, end_;
    };
  } // namespace

  IntegratorEntry rosenbrock_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.make   = [](const scene::Node &node, const IntegratorContext &context) {
      for (const auto &line : context.system.constraints().get_lines())
        if (context.boundary_rates == BoundaryRates::scheme && !line.entries.empty())
          node.refuse("type", "scheme rates are not defined for unknowns that depend on others", "\"time/boundary rates\" = \"exact\"");
      return std::make_unique<Rosenbrock>(context);
    };
    return entry;
  }
} // namespace myolines
