// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stage_problem.h"

#include <stdexcept>

namespace myolines
{
  namespace
  {
    void update_ghosts(State &state)
    {
      state.u.update_ghost_values();
      state.v.update_ghost_values();
      state.a.update_ghost_values();
    }

    constexpr double rounding = 1e-12;
  } // namespace

  StageProblem::StageProblem(StageWork &work, const Stage &stage, State &predictor, const Vector &d, const bool bold)
    : work_(work)
    , stage_(stage)
    , predictor_(predictor)
    , bold_(bold)
    , by_(stage.c.u != 0 ? &State::u : &State::a)
    , c_by_(stage.c.u != 0 ? stage.c.u : stage.c.a)
  {
    if (c_by_ == 0)
      throw std::logic_error("a stage needs c_u or c_a");
    const Weights at = stage.average != nullptr ? stage.average->weight : Weights{1, 1, 1};
    weights_         = stage_weights(stage.scale * at.u * stage.c.u, stage.scale * at.v * stage.c.v, stage.scale * at.a * stage.c.a);
    work_.weights    = weights_[2];
    if (stage.beyond != nullptr) // between the mass that rigid motions meet and that of all others: 1 + chi times it, and it
      weights_[2].a *= 1 + stage.dissipation / 2;
    if (stage.prescribed)
      shift_predictors(d);
    if (stage.c.u != 0 && !work_.capabilities.linear)
      {
        set_end(d); // averages may lie beyond what the body has seen
        start_ = work_.system.local(work_.end.u);
      }
    if (stage.c.u != 0)
      resolution_ = 16 * std::numeric_limits<double>::epsilon() * predictor.u.linfty_norm() / std::abs(stage.c.u);
    if (predicts() && work_.capabilities.rates) // from rest the first guesses are one: nothing would be gained by beginning with it twice
      {
        Vector change(d);
        predict(change);
        change -= d;
        for (const unsigned int row : work_.constrained_rows) // these are given
          change.local_element(row) = 0;
        bold_ = change.linfty_norm() > resolution_;
      }
  }

  void StageProblem::predict(Vector &d) const
  {
    if (stage_.average != nullptr) // forces depend on those of the average
      combine(d, {{1 / stage_.average->weight.v, stage_.first_v}, {-1 / stage_.average->weight.v, &stage_.average->offset->v}});
    else
      combine(d, {{1, stage_.first_v}});
    combine(d, {{1 / stage_.c.v, &d}, {-1 / stage_.c.v, &predictor_.v}});
  }

  void StageProblem::impose(Vector &d) const
  {
    if (!stage_.prescribed)
      {
        work_.free.distribute(d);
        return;
      }
    State &end = work_.end;
    set_end(d);
    work_.system.prescribed(stage_.t, stage_.side, end);
    for (const unsigned int row : work_.constrained_rows)
      d.local_element(row) = target(row);
    d.update_ghost_values();
  }

  Evaluation StageProblem::residual(const Point &at, Vector &f) const
  {
    Evaluation evaluation = work_.system.residual(at, f);
    if (stage_.scale != 1)
      {
        f *= stage_.scale;
        evaluation.forces *= stage_.scale;
        evaluation.local *= stage_.scale;
        evaluation.rounding *= stage_.scale;
      }
    if (stage_.history != nullptr)
      f += *stage_.history;
    if (stage_.c.u == 0) // accelerations follow from what the forces leave, however little
      evaluation.forces = evaluation.rounding = 0;
    return evaluation;
  }

  Evaluation StageProblem::residual_at(const Vector &d, const LocalUnknowns &z, Vector &f)
  {
    Point at = point(d);
    at.local = &z;
    return residual(at, f);
  }

  void StageProblem::local_residual(Vector &g)
  {
    work_.linearisation->local()->local_residual(g);
    g *= stage_.scale;
  }

  /// F has stage.scale times the force of the local unknowns, LocalEquations w.u times.
  void StageProblem::advance(const LocalUnknowns &z, const Vector &dz, const Vector &trial, const double alpha, LocalUnknowns &trial_z)
  {
    work_.local_step = dz;
    work_.local_step *= weights_[2].u / stage_.scale;
    work_.local_step.update_ghost_values();
    work_.system.advance(z, work_.local_step, point(trial), alpha, trial_z);
  }

  void StageProblem::linearise_at(const Vector &d, const LocalUnknowns &z)
  {
    Point at = point(d);
    at.local = &z;
    work_.linearise(at, false);
  }

  bool StageProblem::open_rates(const Vector &d)
  {
    if (stage_.first_v == nullptr || work_.capabilities.linear)
      return false;
    combine(work_.gap, {{1, stage_.first_v}, {-1, &predictor_.v}, {-stage_.c.v, &d}});
    open_ = work_.gap.linfty_norm() > rounding * stage_.first_v->linfty_norm() ? 1 : 0; // none where d belongs to the velocities
    return open_ != 0;
  }

  void StageProblem::lift_rates(Vector &y)
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

  /// Explicit stages have one solution that costs nothing more.
  std::optional<double> StageProblem::importance(const Vector &dx) const
  {
    if (work_.error_norm == nullptr || stage_.c.u == 0)
      return std::nullopt;
    return work_.error_norm->of_solve(dx, stage_.c, work_.error_norm->rms(work_.end.u), work_.error_norm->rms(work_.end.v));
  }

  void StageProblem::finish(const Vector &d)
  {
    open_ = 0;
    set_end(d);
    if (stage_.beyond != nullptr)
      {
        stage_.beyond->evaluate(work_.end.u, work_.beyond);
        combine(work_.end.v, {{1, &work_.end.v}, {1, &work_.beyond}});
        combine(work_.end.a, {{1, &work_.end.a}, {stage_.beyond_rate, &work_.beyond}});
      }
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

  void StageProblem::set_end(const Vector &d) const
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

  Point StageProblem::point(const Vector &d) const
  {
    set_end(d);
    const State &end = work_.end;
    if (stage_.average == nullptr)
      return {stage_.t, stage_.side, end.u, end.v, end.a, nullptr, stage_.before, stage_.dissipation};
    const Stage::Average &at      = *stage_.average;
    State                &average = work_.average;
    combine(average.u, {{1, &at.offset->u}, {at.weight.u, &end.u}});
    combine(average.v, {{1, &at.offset->v}, {at.weight.v, &end.v}});
    combine(average.a, {{1, &at.offset->a}, {at.weight.a, &end.a}});
    if (stage_.beyond != nullptr)
      {
        stage_.beyond->evaluate(end.u, work_.beyond);
        combine(average.a, {{1, &average.a}, {at.weight.a * stage_.beyond_rate, &work_.beyond}});
      }
    update_ghosts(average);
    return {at.t, stage_.side, average.u, average.v, average.a, nullptr, stage_.before, stage_.dissipation};
  }

  void StageProblem::shift_predictors(const Vector &d)
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
} // namespace myolines
