// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// Private to this room.

#include <myolines/solve/free_unknowns.h>
#include <myolines/time/combination.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/stage.h>

#include <cmath>
#include <limits>
#include <optional>

namespace myolines
{
  /// What all stages of an integrator share: the linearisation, and states to compute in.
  class StageWork
  {
  public:
    explicit StageWork(const IntegratorContext &context)
      : system(context.system)
      , rates(context.boundary_rates)
      , error_norm(context.error_norm)
      , ledger(context.ledger)
      , capabilities(system.capabilities())
      , linearisation(system.make_linearisation())
      , gap(context.make_vector())
      , beyond(gap)
      , end(context.make_state())
      , average(end)
      , free(system.constraints(), gap)
    {
      const Vector &layout = gap;
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
    WorkLedger                    &ledger;
    const Capabilities             capabilities;
    std::unique_ptr<Linearisation> linearisation;
    bool                           linearised = false;
    Vector                         local_step; ///< a Newton step of the local unknowns
    Vector                         gap;        ///< from the velocities of the first guess to those given for it
    Vector                         beyond;     ///< Stage::Beyond
    State                          end;        ///< of the stage
    State                          average;    ///< where the residual is evaluated, if not there
    const FreeUnknowns             free;
    Weights                        weights;          ///< of the last stage
    std::vector<unsigned int>      constrained_rows; ///< local numbers
  };

  /// One stage as a nonlinear problem for d.
  class StageProblem : public NonlinearProblem
  {
  public:
    /// @p bold: takes what promises few iterations, and may fail for it; so not if it begins as if not bold.
    StageProblem(StageWork &work, const Stage &stage, State &predictor, const Vector &d, bool bold);

    /// Whether the velocities of the stage tell a first guess of d. Extrapolated displacements violate the volume constraint of nearly
    /// incompressible bodies: they are for systems whose local unknowns are iterates.
    bool predicts() const { return bold_ && start_.any() && stage_.first_v != nullptr && stage_.c.v != 0; }

    /// d of the velocities Stage::first_v.
    void predict(Vector &d) const;

    /// Turns the predictors into the end of the stage. Constrained displacements hold g(t) without the round-off of
    /// u~ + c_u d, and with exact rates their derivatives too.
    void finish(const Vector &d);

    const Constraints &constraints() const override { return work_.system.constraints(); }
    void               impose(Vector &d) const override;

    Evaluation    residual(const Vector &d, Vector &f) override { return residual(point(d), f); }
    LocalUnknowns start_local() const override { return start_; }
    Evaluation    residual_at(const Vector &d, const LocalUnknowns &z, Vector &f) override;
    void          local_residual(Vector &g) override;
    void          advance(const LocalUnknowns &z, const Vector &dz, const Vector &trial, double alpha, LocalUnknowns &trial_z) override;

    void                  linearise(const Vector &d) override { work_.linearise(point(d), weights_[2].u == 0 && weights_[2].v == 0); }
    void                  linearise_at(const Vector &d, const LocalUnknowns &z) override;
    Linearisation        &linearisation() override { return *work_.linearisation; }
    const WeightsByOrder &weights() const override { return weights_; }
    bool                  symmetric() const override { return work_.capabilities.symmetric_tangent && stage_.before == nullptr; }
    bool                  affine() const override { return work_.capabilities.linear; }

    /// At a pressure of its own a body comes back from what a step has stretched. Where rates matter residuals rise at the kink of the
    /// force-velocity curve, and steps that go on from there wander.
    unsigned int patience() const override { return bold_ && start_.any() && !work_.capabilities.rates ? 12 : 0; }

    /// Where rates matter a bold solve that has to shorten its steps comes to nothing.
    unsigned int most_cuts() const override { return predicts() && work_.capabilities.rates ? 1 : NonlinearProblem::most_cuts(); }

    bool open_rates(const Vector &d) override;
    void keep_open(const double share) override { open_ = share; }
    void lift_rates(Vector &y) override;

    /// Sixteen units in the last place of the largest displacement.
    double resolution() const override { return resolution_; }

    std::optional<double> importance(const Vector &dx) const override;

  private:
    Evaluation residual(const Point &at, Vector &f) const;
    void       set_end(const Vector &d) const;
    Point      point(const Vector &d) const;

    /// Value of d with which the constrained unknown @p row reaches what prescribed() has put into work_.end.
    double target(const unsigned int row) const
    {
      return ((work_.end.*by_).local_element(row) - (predictor_.*by_).local_element(row)) / c_by_;
    }

    void shift_predictors(const Vector &d);

    StageWork   &work_;
    const Stage &stage_;
    State       &predictor_;
    bool         bold_;
    Vector State::*by_; ///< the quantity whose prescribed value determines d
    double         c_by_;
    WeightsByOrder weights_;
    LocalUnknowns  start_; ///< those of the displacement that the body has had
    double         resolution_ = 0;
    double         open_       = 0; ///< share of the rate gap
  };
} // namespace myolines
