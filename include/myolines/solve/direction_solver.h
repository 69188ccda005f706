// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/solve/linear_solver.h>
#include <myolines/solve/nonlinear_problem.h>

namespace myolines
{
  /// J dx = b at the linearisation of a problem, for Newton's method.
  class DirectionSolver
  {
  public:
    virtual ~DirectionSolver() = default;

    /// Only rounding is left of b - J dx.
    virtual bool exact() const = 0;

    /// To |b - J dx| <= @p tolerance |b| over the free unknowns, as LinearSolver::solve() does it. A residual below @p enough |b| is
    /// good where the solver stalls. Entries of constrained unknowns of dx come back unspecified.
    /// @p local: where the problem has local unknowns, their part.
    virtual LinearReport solve(NonlinearProblem &problem, const Vector &b, Vector &dx, double tolerance, double enough,
                               const LocalPart *local) = 0;
  };
} // namespace myolines
