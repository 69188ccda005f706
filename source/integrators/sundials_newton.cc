// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/integrators/sundials_newton.h>
#include <myolines/integrators/sundials_versions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace myolines
{
  namespace
  {
    SundialsVector vector_like(N_Vector layout) { return {N_VClone(layout), N_VDestroy}; }
  } // namespace

  SundialsNewton::SundialsNewton(SUNContext context, N_Vector layout, const FirstOrderForm &form)
    : form_(form)
    , solver_(SUNNonlinSolNewEmpty(context))
    , residual_(vector_like(layout))
    , correction_(vector_like(layout))
    , trial_(vector_like(layout))
    , next_(vector_like(layout))
    , before_(vector_like(layout))
  {
    solver_->content              = this;
    solver_->ops->gettype         = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_ROOTFIND; };
    solver_->ops->setsysfn        = [](SUNNonlinearSolver solver, SUNNonlinSolSysFn f) { return of(solver).equations_ = f, 0; };
    solver_->ops->setlsetupfn     = [](SUNNonlinearSolver solver, SUNNonlinSolLSetupFn f) { return of(solver).setup_ = f, 0; };
    solver_->ops->setlsolvefn     = [](SUNNonlinearSolver solver, SUNNonlinSolLSolveFn f) { return of(solver).inverse_ = f, 0; };
    solver_->ops->getnumconvfails = [](SUNNonlinearSolver solver, long *failures) {
      *failures = std::exchange(of(solver).failures_, 0);
      return 0;
    };
    solver_->ops->solve = [](SUNNonlinearSolver solver, N_Vector predicted, N_Vector y, N_Vector weights, const double tolerance,
                             const int fresh_matrix, void *memory) {
      const int flag = of(solver).solve_from_guesses(predicted, y, weights, tolerance, fresh_matrix != 0, memory);
      of(solver).failures_ += flag == sundials_solved ? 0 : 1;
      return flag;
    };
  }

  SundialsNewton::~SundialsNewton() { SUNNonlinSolFreeEmpty(solver_); }

  SundialsNewton &SundialsNewton::of(SUNNonlinearSolver solver) { return *static_cast<SundialsNewton *>(solver->content); }

  int SundialsNewton::linearise(const bool anew, void *memory)
  {
    int renewed = 0, flag = setup_(anew, &renewed, memory);
    if (anew && flag == 0 && renewed == 0) // the first time the solver only notes that its step is another one
      flag = setup_(anew, &renewed, memory);
    current_ = renewed != 0;
    return flag;
  }

  /// -J^-1 times the residual.
  int SundialsNewton::correct(N_Vector correction, void *memory)
  {
    N_VScale(-1, residual_.get(), correction);
    return inverse_(correction, memory);
  }

  /// J and correction at @p y, where the residual is known unless it is to be evaluated.
  int SundialsNewton::renew(N_Vector y, const bool evaluate, void *memory)
  {
    int flag = evaluate ? equations_(y, residual_.get(), memory) : 0;
    if (flag == 0)
      flag = linearise(true, memory);
    return flag == 0 ? correct(correction_.get(), memory) : flag;
  }

  double SundialsNewton::size_of_forces() const
  {
    const std::size_t n = form_.n_free();
    const double     *r = entries(residual_) + n;
    return std::sqrt(dealii::Utilities::MPI::sum(std::inner_product(r, r + n, r, 0.), form_.communicator()));
  }

  /// The trial, its residual and the correction that follows. 1: no part helps.
  int SundialsNewton::try_parts(N_Vector y, N_Vector weights, const double size, void *memory)
  {
    const double forces = size_of_forces();
    for (part_ = 1; part_ >= least_part;)
      {
        N_VLinearSum(1, y, part_, correction_.get(), trial_.get());
        int flag = equations_(trial_.get(), residual_.get(), memory);
        if (flag == 0)
          flag = correct(next_.get(), memory);
        if (flag < 0)
          return flag;
        next_size_          = flag == 0 ? N_VWrmsNorm(next_.get(), weights) : std::numeric_limits<double>::infinity();
        const double enough = 1 - part_ / 4;
        if (next_size_ <= enough * size || (std::isfinite(next_size_) && size_of_forces() <= enough * forces))
          return 0;
        double best = 0;
        if (std::isfinite(next_size_)) // an inadmissible state, which shows nothing, has none
          {
            N_VLinearSum(1, next_.get(), part_ - 1, correction_.get(), trial_.get()); // what is not linear, in proportion to s^2
            best = part_ * part_ * size / (2 * N_VWrmsNorm(trial_.get(), weights));
          }
        part_ = std::clamp(best, part_ / 4, part_ / 2);
      }
    return 1;
  }

  void SundialsNewton::begin_step(N_Vector y)
  {
    N_VScale(1, y, before_.get());
    has_before_ = true;
  }

  /// @p y is the difference from what is predicted.
  int SundialsNewton::solve_from_guesses(N_Vector predicted, N_Vector y, N_Vector weights, const double tolerance, const bool fresh_matrix,
                                         void *memory)
  {
    int flag = SUN_NLS_CONV_RECVR;
    for (const bool from_before : {from_before_, !from_before_})
      {
        N_VConst(0, y);
        if (from_before)
          N_VLinearSum(1, before_.get(), -1, predicted, y);
        flag = solve(y, weights, tolerance, fresh_matrix || from_before != from_before_, memory);
        if (flag == sundials_solved)
          from_before_ = from_before;
        if (flag <= 0 || !has_before_)
          break;
      }
    return flag;
  }

  int SundialsNewton::solve(N_Vector y, N_Vector weights, const double tolerance, const bool fresh_matrix, void *memory)
  {
    current_ = false;
    int flag = equations_(y, residual_.get(), memory);
    if (flag == 0 && fresh_matrix)
      flag = linearise(false, memory);
    if (flag == 0)
      flag = correct(correction_.get(), memory);
    double contraction = 1;
    for (int iteration = 0; flag == 0 && iteration < most_iterations; ++iteration)
      {
        const double size = N_VWrmsNorm(correction_.get(), weights);
        if (contraction * size <= tolerance)
          {
            N_VLinearSum(1, y, 1, correction_.get(), y);
            return sundials_solved;
          }
        flag            = try_parts(y, weights, size, memory);
        const bool none = flag > 0;
        if (flag < 0 || (none && current_))
          break;
        contraction = 1;
        if (!none)
          N_VScale(1, trial_.get(), y);
        if (!none && part_ == 1 && next_size_ <= contraction_that_keeps * size)
          {
            contraction = next_size_ / size;
            std::swap(correction_, next_);
            current_ = false;
          }
        else
          flag = renew(y, none, memory);
      }
    return flag < 0 ? flag : SUN_NLS_CONV_RECVR;
  }
} // namespace myolines
