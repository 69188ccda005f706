// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/stage.h>

#include <functional>

namespace myolines
{
  /// Largest eigenvalues of M^-1 K and M^-1 C, which limit the steps of methods that treat K and C explicitly.
  struct LargestEigenvalues
  {
    double stiffness = 0; ///< [1/s^2]
    double rates     = 0; ///< [1/s]
  };

  /// The largest eigenvalue (of all signs: 0 or less if none is positive) of M^-1 J, J symmetric, y = J x given by @p action. By the method
  /// of Lanczos in the inner product of M from a fixed vector, without reorthogonalisation (Parlett, doi:10.1137/1.9781611971163, 13): from
  /// below, to about 1e-3; one solve with the mass in each of at most 100 iterations. Of a J that is nearly symmetric it is an estimate.
  /// @p solver has been linearised, for its mass. Solves and failures go to @p report; after a failure the number means nothing.
  double largest_eigenvalue(const std::function<void(const Vector &x, Vector &y)> &action, const SemiDiscreteSystem &system,
                            StageSolver &solver, const Vector &layout, StepReport &report);

  /// Those of a system at an admissible @p point, where @p solver is linearised (a linear system: anywhere). The linear solver then holds
  /// what belongs to the mass: NonlinearSolver::forget() before other solves. Ledger: "stable step estimates".
  LargestEigenvalues largest_eigenvalues(const Point &point, const IntegratorContext &context, StageSolver &solver, StepReport &report);
} // namespace myolines
