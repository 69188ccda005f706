// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stage_problem.h"

namespace myolines
{
  /// J d + r = 0 at a fixed linearisation.
  class StageSolver::LinearProblem : public NonlinearProblem
  {
  public:
    /// @p roughly: one linear solve is enough.
    LinearProblem(StageWork &work, const Weights &weights, const Vector &r, const Vector &d, const bool roughly, const double rounding)
      : work_(work)
      , weights_(stage_weights(weights.u, weights.v, weights.a))
      , r_(r)
      , roughly_(roughly)
      , rounding_(rounding)
    {
      for (const unsigned int row : work_.constrained_rows)
        constrained_.push_back(d.local_element(row));
    }

    const Constraints &constraints() const override { return work_.system.constraints(); }

    void impose(Vector &d) const override
    {
      work_.free.distribute(d);
      for (std::size_t i = 0; i < constrained_.size(); ++i)
        d.local_element(work_.constrained_rows[i]) += constrained_[i];
      d.update_ghost_values();
    }

    Evaluation residual(const Vector &d, Vector &f) override
    {
      work_.linearisation->apply(weights_, d, f);
      f += r_;
      Evaluation evaluation;
      evaluation.rounding = rounding_;
      return evaluation;
    }

    void                  linearise(const Vector &) override {}
    Linearisation        &linearisation() override { return *work_.linearisation; }
    const WeightsByOrder &weights() const override { return weights_; }
    bool                  symmetric() const override { return work_.capabilities.symmetric_tangent; }
    bool                  affine() const override { return true; }
    bool                  has_unit_of_residual() const override { return false; }
    std::optional<double> importance(const Vector &) const override { return roughly_ ? std::optional<double>(0) : std::nullopt; }

  private:
    StageWork          &work_;
    WeightsByOrder      weights_;
    const Vector       &r_;
    const bool          roughly_;
    const double        rounding_;
    std::vector<double> constrained_;
  };

  StageSolver::StageSolver(const IntegratorContext &context)
    : work_(std::make_unique<StageWork>(context))
    , solver_(context.solver)
    , linear_(work_->capabilities.linear)
    , d_(context.make_vector())
  {}

  StageSolver::~StageSolver() = default;

  NonlinearReport StageSolver::solve(const Stage &stage, State &point, Vector &d)
  {
    const Vector guess(d);
    StageProblem problem(*work_, stage, point, d, true);
    // Bold: from the displacement that belongs to the first velocities, with residuals that may rise on the way. That saves iterations in
    // most steps; where it leads nowhere the same stage is solved once more without either.
    const bool bold = problem.predicts() || problem.patience() > 0;
    if (problem.predicts())
      problem.predict(d);
    NonlinearReport report = solver_.solve(problem, d);
    if (!report.converged && bold)
      {
        work_->ledger.count("bold solves given up");
        d = guess;
        StageProblem          cautious(*work_, stage, point, d, false);
        const NonlinearReport before = report;
        report                       = solver_.solve(cautious, d);
        report.iterations += before.iterations;
        report.linear_iterations += before.linear_iterations;
        report.residual_evaluations += before.residual_evaluations;
      }
    if (report.converged)
      problem.finish(d);
    return report;
  }

  NonlinearReport StageSolver::solve(const Stage &stage, State &point, const State &last)
  {
    Stage from_last = stage;
    d_              = 0;
    if (stage.c.u != 0)
      from_last.first_v = &last.v;
    if (stage.c.u != 0 && !linear_)
      combine(d_, {{1 / stage.c.u, &last.u}, {-1 / stage.c.u, &point.u}});
    return solve(from_last, point, d_);
  }

  StepReport StageSolver::step(const Stage &stage, State &predictors, State &state)
  {
    StepReport report;
    record(solve(stage, predictors, state), report);
    if (report.accepted())
      swap(state, predictors);
    return report;
  }

  NonlinearReport StageSolver::solve_linear(const Weights &weights, const Vector &r, Vector &d, const bool roughly, const double rounding)
  {
    LinearProblem problem(*work_, weights, r, d, roughly, rounding);
    return solver_.solve(problem, d);
  }

  /// With e the error, x the damped one and g = w.v / w.a: x_u - g x_v = e_u and M x_v + g (C x_v + K x_u) = M e_v, so
  /// (w.u K + w.v C + w.a M) x_u = (w.v C + w.a M) e_u + w.v M e_v. Algebraic unknowns and, in M e_v, those of first order play no part.
  NonlinearReport StageSolver::damp(State &error)
  {
    if (!work_->linearised) // no stage needed an iteration: nothing moves
      {
        NonlinearReport nothing;
        nothing.converged = true;
        return nothing;
      }
    const Weights w = work_->weights;
    for (Vector *x : {&error.u, &error.v})
      work_->free.distribute(*x);
    Vector &r = work_->end.u, &more = work_->end.v;
    r.zero_out_ghost_values();
    more.zero_out_ghost_values();
    work_->linearisation->apply({{Weights{}, Weights{0, w.v, 0}, Weights{0, w.v, w.a}}}, error.u, r);
    work_->linearisation->apply({{Weights{}, Weights{}, Weights{0, 0, w.v}}}, error.v, more);
    combine(r, {{-1, &r}, {-1, &more}});
    Vector &before = work_->end.a;
    before         = error.u;
    error.u        = 0;
    LinearProblem         problem(*work_, w, r, error.u, true, 0);
    const NonlinearReport report = solver_.solve(problem, error.u);
    combine(error.v, {{w.a / w.v, &error.u}, {-w.a / w.v, &before}});
    return report;
  }

  void StageSolver::apply(const Weights &weights, const Vector &x, Vector &y) const
  {
    work_->linearisation->apply(stage_weights(weights.u, weights.v, weights.a), x, y);
  }

  void StageSolver::linearise(const Point &point) { work_->linearise(point, false); }

  void StageSolver::linearise_mass(const Point &point) { work_->linearise(point, true); }

  void record(const NonlinearReport &solve, StepReport &step)
  {
    step.newton_iterations += solve.iterations;
    step.linear_iterations += solve.linear_iterations;
    step.residual_evaluations += solve.residual_evaluations;
    step.initial_residual = solve.initial_residual;
    step.final_residual   = solve.final_residual;
    step.reason           = solve.reason;
    step.advice           = solve.advice;
    step.shorter_steps    = solve.shorter_steps;
    step.outcome          = solve.converged      ? StepReport::Outcome::accepted
                            : solve.inadmissible ? StepReport::Outcome::inadmissible
                                                 : StepReport::Outcome::not_converged;
  }

  void record_estimate(const NonlinearReport &solve, StepReport &step)
  {
    step.linear_iterations += solve.linear_iterations;
    if (solve.converged)
      return;
    step.outcome = StepReport::Outcome::not_converged;
    step.reason  = "the estimate of the error: " + solve.reason;
  }

  void record(const Evaluation &evaluation, StepReport &step)
  {
    ++step.residual_evaluations;
    if (evaluation.admissible)
      return;
    step.outcome = StepReport::Outcome::inadmissible;
    step.reason  = evaluation.reason;
  }
} // namespace myolines
