// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/stage.h>

#include <string>
#include <vector>

namespace myolines
{
  /// Diagonally implicit Runge-Kutta method, stiffly accurate: the last stage is the end of the step.
  ///
  ///     v_i = v_0 + dt sum_j a_ij A_j,   u_i = u_0 + dt sum_j a_ij v_j,   R(t_0 + c_i dt, u_i, v_i, A_i) = 0,   c_i = sum_j a_ij.
  ///
  /// A first stage with a_11 = 0 is the beginning of the step. Unknowns of first order take v_i from u_i alone, algebraic ones
  /// only u_i: both are served by the same formulas.
  struct DirkTable
  {
    std::vector<std::vector<double>> a; ///< row i has i + 1 entries, the diagonal ones > 0 but for the first

    /// The error of a step is estimated as dt sum_i error_i (v_i, A_i), the difference to an embedded formula; empty: it is not.
    std::vector<double> error = {};

    bool   explicit_first_stage() const { return a[0][0] == 0; } ///< the first stage is the beginning of the step
    double c(std::size_t stage) const;                           ///< c_i, the instant of a stage within the step
  };

  /// Steps of a DirkTable with a solver that others may use too. Nothing is remembered from step to step.
  class DirkStepper
  {
  public:
    DirkStepper(DirkTable table, StageSolver &solver, const IntegratorContext &context); ///< shares @p solver

    /// As Integrator::step.
    StepReport step(double dt, State &state);

    /// The end of stage @p i, not the last one, of the last accepted step.
    const State &stage(std::size_t i) const { return stages_[i]; }

  private:
    void   predict(std::size_t stage, double dt, const State &state, State &point);
    void   estimate(double dt, const State &state, StepReport &report);
    double diagonal(std::size_t stage, double dt) const { return table_.a[stage][stage] * dt; }

    DirkTable          table_;
    StageSolver       &solver_;
    const ErrorNorm   *error_norm_; ///< or none
    std::vector<State> stages_;
    State              error_;
  };

  /// The method as an integrator. With an explicit first stage @p integrator holds the choice `first step` (first_step.h).
  /// @throws InputError if the system does not fit the facts.
  std::unique_ptr<Integrator> make_dirk(const DirkTable &table, const MethodFacts &facts, const scene::Node &integrator,
                                        const IntegratorContext &context);
} // namespace myolines
