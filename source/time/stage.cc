#include <myolines/solve/free_unknowns.h>
#include <myolines/time/combination.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/stage.h>

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace myolines
{
  /// What all stages of an integrator share: the linearisation, and states to compute in.
  class StageSolver::Work
  {
  public:
    explicit Work(const IntegratorContext &context)
      : system(context.system)
      , rates(context.boundary_rates)
      , error_norm(context.error_norm)
      , capabilities(system.capabilities())
      , linearisation(system.make_linearisation())
    {}

    /// Vectors come with the first solve: a system gives its layout only through states.
    void allocate(const Vector &layout)
    {
      if (free)
        return;
      free.emplace(system.constraints(), layout);
      gap = layout;
      for (State *state : {&end, &average})
        *state = State{0, layout, layout, layout};
      for (const auto &line : system.constraints().get_lines())
        if (layout.in_local_range(line.index))
          constrained_rows.push_back(layout.get_partitioner()->global_to_local(line.index));
    }

    /// Nothing depends on the point if the system is linear, or if it is only the mass that is asked for.
    void linearise(const Point &point, const bool mass_only)
    {
      if ((linearised && capabilities.linear) || (linearised && mass_only && capabilities.constant_mass))
        return;
      system.linearise(point, *linearisation);
      linearised = true;
    }

    const SemiDiscreteSystem      &system;
    const BoundaryRates            rates;
    const ErrorNorm               *error_norm; ///< or none
    const Capabilities             capabilities;
    std::unique_ptr<Linearisation> linearisation;
    bool                           linearised = false;
    std::optional<FreeUnknowns>    free;
    std::vector<unsigned int>      constrained_rows; ///< local numbers
    Vector                         gap;              ///< from the velocities of the first guess to those given for it
    State                          end;              ///< of the stage
    State                          average;          ///< where the residual is evaluated, if not there
    Weights                        weights;          ///< of the last stage
  };

  namespace
  {
    void update_ghosts(State &state)
    {
      state.u.update_ghost_values();
      state.v.update_ghost_values();
      state.a.update_ghost_values();
    }
  } // namespace

  /// One stage as a nonlinear problem for d.
  class StageSolver::StageProblem : public NonlinearProblem
  {
  public:
    StageProblem(Work &work, const Stage &stage, State &predictor, const Vector &d)
      : work_(work)
      , stage_(stage)
      , predictor_(predictor)
      , by_(stage.c.u != 0 ? &State::u : &State::a)
      , c_by_(stage.c.u != 0 ? stage.c.u : stage.c.a)
    {
      if (c_by_ == 0)
        throw std::logic_error("a stage needs c_u or c_a");
      work_.allocate(d);
      const Weights at = stage.average != nullptr ? stage.average->weight : Weights{1, 1, 1};
      weights_         = stage_weights(stage.scale * at.u * stage.c.u, stage.scale * at.v * stage.c.v, stage.scale * at.a * stage.c.a);
      work_.weights    = weights_[2];
      if (stage.prescribed)
        shift_predictors(d);
    }

    const Constraints &constraints() const override { return work_.system.constraints(); }

    void impose(Vector &d) const override
    {
      if (!stage_.prescribed)
        {
          work_.free->distribute(d);
          return;
        }
      State &end = work_.end;
      set_end(d);
      work_.system.prescribed(stage_.t, stage_.side, end);
      for (const unsigned int row : work_.constrained_rows)
        d.local_element(row) = target(row);
      d.update_ghost_values();
    }

    Evaluation residual(const Vector &d, Vector &f) override
    {
      Evaluation evaluation = work_.system.residual(point(d), f);
      if (stage_.scale != 1)
        f *= stage_.scale;
      if (stage_.history != nullptr)
        f += *stage_.history;
      return evaluation;
    }

    void linearise(const Vector &d) override { work_.linearise(point(d), weights_[2].u == 0 && weights_[2].v == 0); }

    Linearisation        &linearisation() override { return *work_.linearisation; }
    const WeightsByOrder &weights() const override { return weights_; }
    bool                  symmetric() const override { return work_.capabilities.symmetric_tangent; }
    bool                  affine() const override { return work_.capabilities.linear; }

    bool open_rates(const Vector &d) override
    {
      if (stage_.first_v == nullptr || work_.capabilities.linear)
        return false;
      combine(work_.gap, {{1, stage_.first_v}, {-1, &predictor_.v}, {-stage_.c.v, &d}});
      open_ = work_.gap.linfty_norm() > 0 ? 1 : 0;
      return open_ != 0;
    }

    void keep_open(const double share) override { open_ = share; }

    void lift_rates(Vector &y) override
    {
      Vector &gap = work_.gap;
      gap *= open_;
      open_           = 1;
      const double  c = stage_.scale * (stage_.average != nullptr ? stage_.average->weight.v : 1);
      const Weights rate{0, c, 0};
      Vector        part(y);
      gap.update_ghost_values();
      work_.linearisation->apply({{Weights{}, rate, rate}}, gap, part);
      gap.zero_out_ghost_values();
      y -= part;
    }

    /// Sixteen units in the last place of the largest displacement.
    double resolution() const override
    {
      return stage_.c.u == 0 ? 0 : 16 * std::numeric_limits<double>::epsilon() * predictor_.u.linfty_norm() / std::abs(stage_.c.u);
    }

    /// Explicit stages have one solution that costs nothing more.
    std::optional<double> importance(const Vector &dx) const override
    {
      if (work_.error_norm == nullptr || stage_.c.u == 0)
        return std::nullopt;
      return work_.error_norm->of_solve(dx, stage_.c, work_.error_norm->rms(work_.end.u), work_.error_norm->rms(work_.end.v));
    }

    /// Turns the predictors into the end of the stage. Constrained displacements hold g(t) without the round-off of
    /// u~ + c_u d, and with exact rates their derivatives too.
    void finish(const Vector &d)
    {
      open_ = 0;
      set_end(d);
      swap(work_.end, predictor_);
      State &state = predictor_;
      if (stage_.prescribed && work_.rates == BoundaryRates::exact)
        work_.system.prescribed(stage_.t, stage_.side, state);
      else if (stage_.prescribed)
        {
          State &exact = work_.end;
          exact        = state;
          work_.system.prescribed(stage_.t, stage_.side, exact);
          for (const unsigned int row : work_.constrained_rows)
            state.u.local_element(row) = exact.u.local_element(row);
        }
      update_ghosts(state);
    }

  private:
    void set_end(const Vector &d) const
    {
      State &end = work_.end;
      end.t      = stage_.t;
      combine(end.u, {{1, &predictor_.u}, {stage_.c.u, &d}});
      combine(end.v, {{1, &predictor_.v}, {stage_.c.v, &d}});
      if (open_ != 0)
        combine(end.v, {{1, &end.v}, {open_, &work_.gap}});
      combine(end.a, {{1, &predictor_.a}, {stage_.c.a, &d}});
      update_ghosts(end);
    }

    Point point(const Vector &d) const
    {
      set_end(d);
      const State &end = work_.end;
      if (stage_.average == nullptr)
        return {stage_.t, stage_.side, end.u, end.v, end.a};
      const Stage::Average &at      = *stage_.average;
      State                &average = work_.average;
      combine(average.u, {{1, &at.offset->u}, {at.weight.u, &end.u}});
      combine(average.v, {{1, &at.offset->v}, {at.weight.v, &end.v}});
      combine(average.a, {{1, &at.offset->a}, {at.weight.a, &end.a}});
      update_ghosts(average);
      return {at.t, stage_.side, average.u, average.v, average.a};
    }

    /// Value of d with which the constrained unknown @p row reaches what prescribed() has put into work_.end.
    double target(const unsigned int row) const
    {
      return ((work_.end.*by_).local_element(row) - (predictor_.*by_).local_element(row)) / c_by_;
    }

    void shift_predictors(const Vector &d)
    {
      const bool exact = work_.rates == BoundaryRates::exact, explicit_stage = stage_.c.u == 0;
      if (!exact && !explicit_stage)
        return;
      set_end(d);
      const State &end = work_.end;
      work_.system.prescribed(stage_.t, stage_.side, work_.end);
      for (const unsigned int row : work_.constrained_rows)
        {
          const double value = target(row);
          if (explicit_stage)
            predictor_.u.local_element(row) = end.u.local_element(row);
          else
            predictor_.a.local_element(row) = end.a.local_element(row) - stage_.c.a * value;
          if (exact)
            predictor_.v.local_element(row) = end.v.local_element(row) - stage_.c.v * value;
        }
    }

    Work        &work_;
    const Stage &stage_;
    State       &predictor_;
    Vector State::*by_; ///< the quantity whose prescribed value determines d
    double         c_by_;
    WeightsByOrder weights_;
    double         open_ = 0; ///< share of the rate gap
  };

  /// J d + r = 0 at a fixed linearisation.
  class StageSolver::LinearProblem : public NonlinearProblem
  {
  public:
    /// @p roughly: one linear solve is enough.
    LinearProblem(Work &work, const Weights &weights, const Vector &r, const Vector &d, const bool roughly)
      : work_(work)
      , weights_(stage_weights(weights.u, weights.v, weights.a))
      , r_(r)
      , roughly_(roughly)
    {
      work_.allocate(d);
      for (const unsigned int row : work_.constrained_rows)
        constrained_.push_back(d.local_element(row));
    }

    const Constraints &constraints() const override { return work_.system.constraints(); }

    void impose(Vector &d) const override
    {
      work_.free->distribute(d);
      for (std::size_t i = 0; i < constrained_.size(); ++i)
        d.local_element(work_.constrained_rows[i]) += constrained_[i];
      d.update_ghost_values();
    }

    Evaluation residual(const Vector &d, Vector &f) override
    {
      work_.linearisation->apply(weights_, d, f);
      f += r_;
      return {};
    }

    void                  linearise(const Vector &) override {}
    Linearisation        &linearisation() override { return *work_.linearisation; }
    const WeightsByOrder &weights() const override { return weights_; }
    bool                  symmetric() const override { return work_.capabilities.symmetric_tangent; }
    bool                  affine() const override { return true; }
    bool                  has_unit_of_residual() const override { return false; }
    std::optional<double> importance(const Vector &) const override { return roughly_ ? std::optional<double>(0) : std::nullopt; }

  private:
    Work               &work_;
    WeightsByOrder      weights_;
    const Vector       &r_;
    const bool          roughly_;
    std::vector<double> constrained_;
  };

  StageSolver::StageSolver(const IntegratorContext &context)
    : work_(std::make_unique<Work>(context))
    , solver_(context.solver)
  {}

  StageSolver::~StageSolver() = default;

  NonlinearReport StageSolver::solve(const Stage &stage, State &point, Vector &d)
  {
    StageProblem          problem(*work_, stage, point, d);
    const NonlinearReport report = solver_.solve(problem, d);
    if (report.converged)
      problem.finish(d);
    return report;
  }

  StepReport StageSolver::step(const Stage &stage, State &predictors, Vector &d, State &state)
  {
    StepReport report;
    record(solve(stage, predictors, d), report);
    if (report.accepted())
      swap(state, predictors);
    return report;
  }

  NonlinearReport StageSolver::solve_linear(const Weights &weights, const Vector &r, Vector &d, const bool roughly)
  {
    LinearProblem problem(*work_, weights, r, d, roughly);
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
      work_->free->distribute(*x);
    Vector &r = work_->end.u, &more = work_->end.v;
    r.zero_out_ghost_values();
    more.zero_out_ghost_values();
    work_->linearisation->apply({{Weights{}, Weights{0, w.v, 0}, Weights{0, w.v, w.a}}}, error.u, r);
    work_->linearisation->apply({{Weights{}, Weights{}, Weights{0, 0, w.v}}}, error.v, more);
    combine(r, {{-1, &r}, {-1, &more}});
    Vector &before = work_->end.a;
    before         = error.u;
    error.u        = 0;
    LinearProblem         problem(*work_, w, r, error.u, true);
    const NonlinearReport report = solver_.solve(problem, error.u);
    combine(error.v, {{w.a / w.v, &error.u}, {-w.a / w.v, &before}});
    return report;
  }

  void StageSolver::apply(const Weights &weights, const Vector &x, Vector &y) const
  {
    work_->linearisation->apply(stage_weights(weights.u, weights.v, weights.a), x, y);
  }

  void StageSolver::linearise(const Point &point) { work_->linearise(point, false); }

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
