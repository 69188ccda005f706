#include <myolines/time/stage.h>

#include <stdexcept>

namespace myolines
{
  /// One stage as a nonlinear problem for d. Linear systems are linearised once and for all.
  class StageSolver::Problem : public NonlinearProblem
  {
  public:
    explicit Problem(const IntegratorContext &context)
      : system_(context.system)
      , rates_(context.boundary_rates)
      , capabilities_(system_.capabilities())
      , linearisation_(system_.make_linearisation())
    {}

    /// Takes the predictors; with exact rates shifts those of constrained unknowns so that the stage ends at (g, g', g'').
    void begin(const Stage &stage, const State &predictor, const Vector &d)
    {
      if (stage.c.u == 0)
        throw std::logic_error("a stage needs c_u != 0");
      stage_     = &stage;
      weights_   = stage_weights(stage.scale * stage.c.u, stage.scale * stage.c.v, stage.scale * stage.c.a);
      predictor_ = predictor;
      if (rates_ == BoundaryRates::exact)
        shift_rates(d);
    }

    /// The point of the stage at @p d.
    State point(const Vector &d) const
    {
      State state = predictor_;
      state.t     = stage_->t;
      state.u.add(stage_->c.u, d);
      state.v.add(stage_->c.v, d);
      state.a.add(stage_->c.a, d);
      return state;
    }

    const Constraints &constraints() const override { return system_.constraints(); }

    void impose(Vector &d) const override
    {
      State state = point(d);
      system_.prescribed(stage_->t, stage_->side, state);
      for (const unsigned int row : constrained_rows(d))
        d.local_element(row) = (state.u.local_element(row) - predictor_.u.local_element(row)) / stage_->c.u;
      d.update_ghost_values();
    }

    Evaluation residual(const Vector &d, Vector &f) override
    {
      State state = point(d);
      update_ghosts(state);
      Evaluation evaluation = system_.residual({stage_->t, stage_->side, state.u, state.v, state.a}, f);
      f *= stage_->scale;
      if (stage_->history != nullptr)
        f += *stage_->history;
      return evaluation;
    }

    void linearise(const Vector &d) override
    {
      if (capabilities_.linear && linearised_)
        return;
      State state = point(d);
      update_ghosts(state);
      system_.linearise({stage_->t, stage_->side, state.u, state.v, state.a}, *linearisation_);
      linearised_ = true;
    }

    Linearisation        &linearisation() override { return *linearisation_; }
    const WeightsByOrder &weights() const override { return weights_; }
    bool                  symmetric() const override { return capabilities_.symmetric_tangent; }

    /// Constrained displacements of a solved stage hold g(t) without the round-off of u~ + c_u d, and with exact rates
    /// their derivatives too.
    void finish(State &state) const
    {
      if (rates_ == BoundaryRates::exact)
        system_.prescribed(stage_->t, stage_->side, state);
      else
        {
          State exact = state;
          system_.prescribed(stage_->t, stage_->side, exact);
          state.u = exact.u;
        }
      update_ghosts(state);
    }

  private:
    static void update_ghosts(State &state)
    {
      state.u.update_ghost_values();
      state.v.update_ghost_values();
      state.a.update_ghost_values();
    }

    const std::vector<unsigned int> &constrained_rows(const Vector &layout) const
    {
      if (!rows_known_)
        for (const auto &line : system_.constraints().get_lines())
          if (layout.in_local_range(line.index))
            rows_.push_back(layout.get_partitioner()->global_to_local(line.index));
      rows_known_ = true;
      return rows_;
    }

    void shift_rates(const Vector &d)
    {
      State end = point(d);
      system_.prescribed(stage_->t, stage_->side, end);
      for (const unsigned int row : constrained_rows(d))
        {
          const double target             = (end.u.local_element(row) - predictor_.u.local_element(row)) / stage_->c.u;
          predictor_.v.local_element(row) = end.v.local_element(row) - stage_->c.v * target;
          predictor_.a.local_element(row) = end.a.local_element(row) - stage_->c.a * target;
        }
    }

    const SemiDiscreteSystem      &system_;
    const BoundaryRates            rates_;
    const Capabilities             capabilities_;
    std::unique_ptr<Linearisation> linearisation_;
    bool                           linearised_ = false;
    const Stage                   *stage_      = nullptr;
    State                          predictor_;
    WeightsByOrder                 weights_;

    mutable bool                      rows_known_ = false; // constraints are constant, but known only with a layout
    mutable std::vector<unsigned int> rows_;
  };

  StageSolver::StageSolver(const IntegratorContext &context)
    : problem_(std::make_unique<Problem>(context))
    , solver_(context.solver)
  {}

  StageSolver::~StageSolver() = default;

  NonlinearReport StageSolver::solve(const Stage &stage, State &point, Vector &d)
  {
    problem_->begin(stage, point, d);
    const NonlinearReport report = solver_.solve(*problem_, d);
    if (report.converged)
      {
        point = problem_->point(d);
        problem_->finish(point);
      }
    return report;
  }

  StepReport StageSolver::step(const Stage &stage, State predictors, State &state)
  {
    Vector increment(state.u);
    increment = 0;
    StepReport report;
    record(solve(stage, predictors, increment), report);
    if (report.accepted())
      std::swap(state, predictors);
    return report;
  }

  State starting_state(const SemiDiscreteSystem &system, const double t0, const BoundaryRates rates)
  {
    State state = system.initial_state(t0);
    if (rates == BoundaryRates::scheme)
      {
        for (Vector *x : {&state.v, &state.a})
          {
            x->zero_out_ghost_values();
            for (const auto &line : system.constraints().get_lines())
              if (x->in_local_range(line.index))
                (*x)(line.index) = 0;
            x->update_ghost_values();
          }
      }
    return state;
  }

  void start_piece(const IntegratorContext &context, State &state)
  {
    if (context.boundary_rates == BoundaryRates::exact)
      context.system.prescribed(state.t, Side::right, state);
  }

  void record(const NonlinearReport &solve, StepReport &step)
  {
    step.newton_iterations += solve.iterations;
    step.linear_iterations += solve.linear_iterations;
    step.residual_evaluations += solve.residual_evaluations;
    step.initial_residual = solve.initial_residual;
    step.final_residual   = solve.final_residual;
    step.reason           = solve.reason;
    step.outcome          = solve.converged      ? StepReport::Outcome::accepted
                            : solve.inadmissible ? StepReport::Outcome::inadmissible
                                                 : StepReport::Outcome::not_converged;
  }
} // namespace myolines
