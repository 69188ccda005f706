// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/dirk.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/first_step.h>
#include <myolines/time/start.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace myolines
{
  namespace
  {
    /// The first and the last instant at which stages of @p table look, in steps: 0 and 1, or before and beyond.
    std::pair<double, double> span_of_stages(const DirkTable &table)
    {
      constexpr double rounding = 1e-9; // of coefficients with a dozen digits
      double           first = 0, last = 1;
      for (std::size_t i = 0; i + 1 < table.a.size(); ++i) // the last one is the end of the step
        {
          const double c = table.c(i);
          first          = c < -rounding ? std::min(first, c) : first;
          last           = c > 1 + rounding ? std::max(last, c) : last;
        }
      return {first, last};
    }

    class DirkMethod : public Integrator
    {
    public:
      DirkMethod(const DirkTable &table, const IntegratorContext &context)
        : context_(context)
        , solver_(context)
        , stepper_(table, solver_, context)
      {}

      void       start(State &state) override { start_piece(context_, solver_, state); }
      StepReport step(const double dt, State &state) override { return stepper_.step(dt, state); }

    private:
      const IntegratorContext context_;
      StageSolver             solver_;
      DirkStepper             stepper_;
    };

    /// For tables whose first stage is explicit, and those with stages before the step or beyond it: steps that would look into another
    /// smooth piece, where loads are others, are L-stable ones.
    class StartedDirkMethod : public Integrator
    {
    public:
      StartedDirkMethod(const DirkTable &table, const FirstStep first, const unsigned int order, const IntegratorContext &context)
        : system_(context.system)
        , last_(span_of_stages(table).second)
        , solver_(context)
        , stepper_(table, solver_, context)
        , starter_(first, solver_, context, order, table.explicit_first_stage() || span_of_stages(table).first < 0 ? 1 : 0)
      {}

      void       start(State &state) override { starter_.start(state); }
      StepReport step(const double dt, State &state) override
      {
        if (last_ > 1 && !system_.events(state.t, state.t + last_ * dt).empty())
          starter_.kink_ahead();
        return starter_.takes_next_step() ? starter_.step(dt, state) : stepper_.step(dt, state);
      }
      void remember(Memory &memory) override { starter_.remember(memory); }

    private:
      const SemiDiscreteSystem &system_;
      const double              last_; ///< instant at which a stage looks, in steps
      StageSolver               solver_;
      DirkStepper               stepper_;
      Starter                   starter_;
    };

    void add(Vector &y, const double factor, const Vector &x) { combine(y, {{1, &y}, {factor, &x}}); }
  } // namespace

  double DirkTable::c(const std::size_t stage) const { return std::accumulate(a[stage].begin(), a[stage].end(), 0.); }

  DirkStepper::DirkStepper(DirkTable table, StageSolver &solver, const IntegratorContext &context)
    : table_(std::move(table))
    , solver_(solver)
    , error_norm_(context.error_norm)
    , stages_(table_.a.size(), context.make_state())
  {
    if (error_norm_ != nullptr)
      error_ = context.make_state();
  }

  /// With g = a_ii dt and the sums over the stages before, u^ and v^: u = u^ + g v, v = v^ + g a, so u = u~ + g^2 a for
  /// u~ = u^ + g v^, and v~ = v^, a~ = 0.
  void DirkStepper::predict(const std::size_t i, const double dt, const State &state, State &point)
  {
    const double g = diagonal(i, dt);
    combine(point.v, {{1, &state.v}});
    for (std::size_t j = 0; j < i; ++j)
      add(point.v, dt * table_.a[i][j], stages_[j].a);
    combine(point.u, {{g, &point.v}});
    for (std::size_t j = 0; j < i; ++j)
      add(point.u, dt * table_.a[i][j], stages_[j].v);
    add(point.u, 1, state.u);
    point.a = 0;
  }

  StepReport DirkStepper::step(const double dt, State &state)
  {
    StepReport        report;
    const std::size_t n_stages = table_.a.size(), first = table_.explicit_first_stage() ? 1 : 0;
    if (first == 1)
      {
        combine(stages_[0].u, {{1, &state.u}});
        combine(stages_[0].v, {{1, &state.v}});
        combine(stages_[0].a, {{1, &state.a}});
      }
    for (std::size_t i = first; i < n_stages; ++i)
      {
        const double g    = diagonal(i, dt);
        const bool   last = i + 1 == n_stages;
        Stage        stage;
        stage.t = last ? state.t + dt : state.t + table_.c(i) * dt;
        stage.c = {1, 1 / g, 1 / (g * g)};
        predict(i, dt, state, stages_[i]);
        record(solver_.solve(stage, stages_[i], i == 0 ? state : stages_[i - 1]), report);
        if (!report.accepted())
          return report;
      }
    if (error_norm_ != nullptr && !table_.error.empty())
      estimate(dt, state, report);
    if (report.accepted())
      swap(state, stages_.back());
    return report;
  }

  void DirkStepper::estimate(const double dt, const State &state, StepReport &report)
  {
    error_.u = 0;
    error_.v = 0;
    for (std::size_t i = 0; i < stages_.size(); ++i)
      {
        add(error_.u, dt * table_.error[i], stages_[i].v);
        add(error_.v, dt * table_.error[i], stages_[i].a);
      }
    record_estimate(solver_.damp(error_), report);
    if (report.accepted())
      ErrorNorm::judge(error_norm_->of_step(error_.u, &error_.v, state, stages_.back()), report);
  }

  std::unique_ptr<Integrator> make_dirk(const DirkTable &table, const MethodFacts &facts, const scene::Node &integrator,
                                        const IntegratorContext &context)
  {
    if (!table.explicit_first_stage() && span_of_stages(table) == std::pair(0., 1.))
      return std::make_unique<DirkMethod>(table, context);
    require_fitting_first_step(facts, integrator, context);
    return std::make_unique<StartedDirkMethod>(table, first_step(integrator), facts.order, context);
  }
} // namespace myolines
