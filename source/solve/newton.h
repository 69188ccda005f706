// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/solve/lifted_function.h>
#include <myolines/solve/newton_steps.h>
#include <myolines/solve/nonlinear_solver.h>

#include <optional>

namespace myolines
{
  /// The parts of one solve with Newton's method that do not depend on who drives it: verdict, direction, step length, messages.
  /// See the class comment of NonlinearSolver.
  class Newton
  {
  public:
    /// Parameters of `solver/nonlinear`.
    struct Options
    {
      explicit Options(const scene::Node &nonlinear);

      double                relative_tolerance;
      std::optional<double> absolute_tolerance;
      unsigned int          maximum_iterations, maximum_cuts;
      double                forcing_minimum, forcing_maximum;
    };

    enum class Verdict
    {
      go_on,
      converged,
      failed ///< report().reason says why
    };

    Newton(const Options &options, NonlinearProblem &problem, LiftedFunction &function, DirectionSolver &solver, WorkLedger &ledger,
           const StopRequest &stop);

    /// G at the first guess @p at .x. False: it is inadmissible.
    bool begin(Iterate &at);

    Verdict judge(const Iterate &at);

    /// False: the linear solver failed.
    bool direction(Iterate &at, double tolerance, Vector &dx);

    /// @p to = @p from + alpha @p dx, with the alpha that is taken; none: the line search failed.
    std::optional<double> search(const Iterate &from, const Vector &dx, Iterate &to);

    /// Ends the solve for a reason from elsewhere.
    void fail(const std::string &reason);

    /// The solve so far.
    const NonlinearReport &report();

  private:
    double tolerance(const Evaluation &evaluation) const;
    bool   at_rounding(const Evaluation &evaluation) const;
    bool   lowers(const Iterate &from, double alpha, const Iterate &to);
    void   fail_search(const Iterate &from, const Vector &dx, const Iterate &trial, unsigned int cuts, double alpha);
    void   advise_looser_tolerance(const Evaluation &evaluation);
    bool   note_indefinite_tangent(const Iterate &at, const Vector &dx);

    const Options    &options_;
    NonlinearProblem &problem_;
    LiftedFunction   &function_;
    DirectionSolver  &solver_;
    WorkLedger       &ledger_;
    const StopRequest stop_;
    NonlinearReport   report_;
    NewtonSteps       steps_;
    bool              below_resolution_ = false; ///< the last direction is
    unsigned int      waited_           = 0;     ///< steps since the residual was last below all before, shortened ones fourfold
    double            lowest_           = 0;     ///< that residual, where waited_ > 0
  };
} // namespace myolines
