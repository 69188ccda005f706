// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/solve/linear_solver.h>
#include <myolines/solve/nonlinear_problem.h>
#include <myolines/system/ledger.h>

#include <memory>
#include <string>

namespace myolines
{
  /// How a nonlinear solve ended: a value, never an exception.
  struct NonlinearReport
  {
    bool         converged    = false;        ///< whether the tolerance was met
    bool         inadmissible = false;        ///< failed because no admissible point was found along the step
    std::string  reason;                      ///< why not converged; empty if it did
    std::string  advice;                      ///< what may help against that, beside shorter steps; empty: nothing else
    bool         shorter_steps        = true; ///< whether those may help
    unsigned int iterations           = 0;    ///< Newton steps = linear solves
    unsigned int linear_iterations    = 0;    ///< in all Newton steps
    unsigned int residual_evaluations = 0;    ///< those of the line search among them
    double       initial_residual     = 0;    ///< l2 norm over free unknowns after the Dirichlet lift (to first order) [unit of F]
    double       final_residual       = 0;    ///< the same at the end
  };

  /// Inexact Newton (Eisenstat and Walker, doi:10.1137/0917003, choice 2) with a safeguarded line search: NOX drives it, or a plain loop
  /// where the linearisation is a narrow band (BandDirections). Local unknowns of the problem are iterates beside x.
  ///
  /// Converged: nothing is left to lift, and the residual with local unknowns eliminated is below relative tolerance times the forces that
  /// it balances, or below what rounding leaves of it (Evaluation), or below the absolute tolerance; of problems that do not tell their
  /// forces the tolerance is relative to |F_free after the lift|. A Newton step below the resolution of x has converged too, and, where
  /// the problem tells the importance of Newton steps, a solve of which what remains does not matter (NewtonSteps).
  /// Line search: accept |G| <= (1 - 1e-4 alpha) |G_0|, else quadratic interpolation clamped to [0.1, 0.5] of the last alpha; halve at
  /// inadmissible points; at most `line search cuts` cuts. A patient problem
  /// (NonlinearProblem::patience) accepts larger ones for a while. |G| holds the residual of the local unknowns too.
  ///
  /// Ledger: "nonlinear solves", "newton iterations", "line search cuts". Prints nothing.
  class NonlinearSolver
  {
  public:
    /// Parameters of the list `solver/nonlinear`.
    static scene::Schema schema();

    /// Of that list. @p linear and @p ledger outlive it.
    NonlinearSolver(const scene::Node &nonlinear, LinearSolver &linear, WorkLedger &ledger);
    ~NonlinearSolver();

    /// Solves from @p x; on failure x is unspecified. Each solve counts as a new step of the linear solver.
    NonlinearReport solve(NonlinearProblem &problem, Vector &x);

    /// Drops what the linear solver has kept, before solves of another kind than the last ones.
    void forget();

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
  };
} // namespace myolines
