// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/integrators/sundials_tools.h>

#include <sundials/sundials_nonlinearsolver.h>

namespace myolines
{
  /// Newton's method for the equations F(y) = 0 that a solver of SUNDIALS has in a step or a stage, y = (u, v): damped, and with matrices
  /// as fresh as they need be.
  ///
  /// Of the correction d = -J^-1 F(y) the part s is taken, 1 or less, for which one of two tests holds:
  ///   |d'| <= (1 - s/4) |d| in the norm of the solver, d' = -J^-1 F(y + s d) being the correction that follows with the same J (Deuflhard,
  ///   Newton Methods for Nonlinear Problems, doi:10.1007/978-3-642-23899-4, section 3.3), which sees neither scales nor stiff constraints;
  ///   |F_v| <= (1 - s/4) times what it was, F_v the rows of forces, which sees through the bends of a force-velocity relation.
  /// J and d' are kept while whole corrections shrink by contraction_that_keeps; else J is that of the new iterate. The iteration ends
  /// where |d| times the contraction last seen is the tolerance that the solver gives.
  ///
  /// It begins at the state that the solver predicts, or, where no solution is found from there, at that at the beginning of the step: what
  /// is extrapolated after a jump of velocities has velocities and volumes that no muscle has. What succeeded last is tried first.
  ///
  /// The method that SUNDIALS brings takes whole corrections. Where forces bend within the velocities of a step these do not converge,
  /// however short steps are, since velocities that balance the forces do not depend on the step.
  class SundialsNewton
  {
  public:
    /// For vectors like @p layout, those of @p form, which is borrowed.
    SundialsNewton(SUNContext context, N_Vector layout, const FirstOrderForm &form);
    ~SundialsNewton();
    SundialsNewton(const SundialsNewton &)            = delete; ///< SUNDIALS keeps a pointer to the object.
    SundialsNewton &operator=(const SundialsNewton &) = delete;

    SUNNonlinearSolver solver() const { return solver_; } ///< for calls of SUNDIALS

    void begin_step(N_Vector y); ///< Another first guess of the steps that follow; without it there is none.

  private:
    static constexpr int    most_iterations        = 25;
    static constexpr double least_part             = 1. / 64; ///< of a correction; rough linear solves show no decrease below it
    static constexpr double contraction_that_keeps = 0.25;

    static SundialsNewton &of(SUNNonlinearSolver solver);

    ///@{
    /// Flags of SUNDIALS: 0, positive where a shorter step may help, negative where nothing does.
    int solve_from_guesses(N_Vector predicted, N_Vector y, N_Vector weights, double tolerance, bool fresh_matrix, void *memory);
    int solve(N_Vector y, N_Vector weights, double tolerance, bool fresh_matrix, void *memory);
    int linearise(bool anew, void *memory);
    int correct(N_Vector correction, void *memory);
    int renew(N_Vector y, bool evaluate, void *memory);
    int try_parts(N_Vector y, N_Vector weights, double size, void *memory);
    ///@}

    double size_of_forces() const;

    const FirstOrderForm &form_;
    SUNNonlinearSolver    solver_;
    SUNNonlinSolSysFn     equations_ = nullptr;
    SUNNonlinSolLSetupFn  setup_     = nullptr;
    SUNNonlinSolLSolveFn  inverse_   = nullptr;
    SundialsVector        residual_, correction_, trial_, next_, before_;
    bool                  has_before_ = false, from_before_ = false; ///< the latter: where the last success began
    double                part_ = 1, next_size_ = 0;                 ///< s and |d'| of the trial
    bool                  current_  = false;                         ///< J is that of the iterate
    long                  failures_ = 0;                             ///< since SUNDIALS has asked
  };
} // namespace myolines
