// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/norm.h>
#include <myolines/solve/lifted_function.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines
{
  LiftedFunction::LiftedFunction(const Constraints &constraints, const Vector &layout, WorkLedger &ledger)
    : constraints_(&constraints)
    , ledger_(ledger)
    , free_(constraints, layout)
    , gap_(layout)
    , lift_(layout)
    , rate_lift_(layout)
    , right_(layout)
    , true_(layout)
  {}

  bool LiftedFunction::fits(const NonlinearProblem &problem, const Vector &x) const
  {
    return constraints_ == &problem.constraints() && gap_.get_partitioner() == x.get_partitioner();
  }

  void LiftedFunction::set_norm(Iterate &at) const { at.norm = std::hypot(norm_or_nan(at.g), at.evaluation.local); }

  void LiftedFunction::set_gap(const NonlinearProblem &problem, const Vector &x)
  {
    gap_.zero_out_ghost_values();
    std::copy(x.begin(), x.end(), gap_.begin());
    problem.impose(gap_);
    gap_.zero_out_ghost_values();
    for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
      gap_.local_element(i) -= x.local_element(i); // exactly zero on free unknowns, which impose() leaves alone
    gap_.update_ghost_values();
  }

  void LiftedFunction::linearise(NonlinearProblem &problem, const Iterate &at)
  {
    if (linearised_at_ == at.stamp)
      return;
    const WorkLedger::Timer timer(ledger_, "assembly");
    if (at.z.any())
      problem.linearise_at(at.x, at.z);
    else
      problem.linearise(at.x);
    linearised_at_ = at.stamp;
  }

  /// gap_ is that of the point. G becomes the residual that the free unknowns would see, to first order, with the constrained ones at their
  /// targets: a first guess whose boundary has not moved is then judged by what its move costs.
  void LiftedFunction::add_lift(NonlinearProblem &problem, Iterate &at)
  {
    linearise(problem, at);
    if (at.z.any())
      {
        const LocalEquations &local = *problem.linearisation().local();
        if (dz_.size() == 0)
          dz_ = lift_z_ = right_z_ = local.make_local();
        right_z_ = 0;
        local.apply_with_local(problem.weights(), LocalEquations::Digits::single, gap_, right_z_, lift_, lift_z_);
      }
    else
      problem.linearisation().apply(problem.weights(), gap_, lift_);
    if (has_rate_gap_)
      {
        rate_lift_ = 0;
        problem.lift_rates(rate_lift_); // takes (dF/dw) w away
        lift_ += rate_lift_;
      }
    free_.condense(lift_);
    at.g += lift_;
    at.remaining = 1;
    set_norm(at);
    lifted_at_ = at.stamp;
  }

  void LiftedFunction::evaluate(NonlinearProblem &problem, Iterate &at)
  {
    ++evaluations_;
    at.evaluation = at.z.any() ? problem.residual_at(at.x, at.z, at.g) : problem.residual(at.x, at.g);
    at.norm       = std::numeric_limits<double>::quiet_NaN();
    at.undefined  = false;
    if (!at.evaluation.admissible)
      return;
    free_.condense(at.g);
    set_norm(at);
    at.undefined = !std::isfinite(at.norm);
    if (at.undefined)
      at.evaluation = {false, "the residual is not a finite number: a load or motion by a formula, perhaps, that is not defined there"};
  }

  void LiftedFunction::first(NonlinearProblem &problem, const bool with_rates, Iterate &at)
  {
    evaluations_  = 0;
    has_rate_gap_ = with_rates && problem.open_rates(at.x);
    at.z          = problem.start_local();
    at.stamp      = new_stamp();
    at.remaining  = 0;
    set_gap(problem, at.x);
    const bool finite = std::isfinite(norm_or_nan(gap_)), rounding = finite && gap_.linfty_norm() <= problem.resolution();
    if (rounding)
      {
        problem.impose(at.x);
        gap_ = 0;
      }
    evaluate(problem, at);
    if (!finite)
      {
        at.undefined  = true;
        at.evaluation = {false, "a prescribed value is not a finite number: a formula or drive is not defined at this time"};
      }
    if (at.evaluation.admissible && (has_rate_gap_ || !rounding))
      add_lift(problem, at);
  }

  void LiftedFunction::move(NonlinearProblem &problem, const Iterate &from, const Vector &dx, const double alpha, Iterate &to)
  {
    to.stamp     = new_stamp();
    to.remaining = (1 - alpha) * from.remaining;
    to.x         = from.x;
    to.x.add(alpha, dx);
    if (to.remaining == 0)
      problem.impose(to.x); // without the round-off of x + dx
    to.x.update_ghost_values();
    if (has_rate_gap_)
      problem.keep_open(to.remaining);
    if (from.z.any())
      problem.advance(from.z, dz_, to.x, alpha, to.z);
    evaluate(problem, to);
    if (to.remaining != 0 && to.evaluation.admissible) // (1 - alpha) J gap, with the J of the point that was lifted
      {
        to.g.add(to.remaining, lift_);
        set_norm(to);
      }
  }

  /// Of the relative tolerances of linear solves; what is beyond is rounding.
  constexpr double tightest = 1e-10;

  /// Part of |G| that a Newton direction may leave where the linear solver stalls.
  constexpr double enough = 0.1;

  LinearReport LiftedFunction::direction(NonlinearProblem &problem, DirectionSolver &solver, Iterate &at, const double tolerance,
                                         const double absolute, Vector &dx)
  {
    linearise(problem, at);
    const bool open = at.remaining != 0;
    if (open && lifted_at_ != at.stamp)
      {
        at.g.add(-at.remaining, lift_); // of the former point, whose J is no longer that of the direction
        set_gap(problem, at.x);
        add_lift(problem, at);
      }
    right_ = at.g;
    right_ *= -1;
    const double goal = std::max(tolerance, at.norm > 0 ? std::min(0.5, absolute / at.norm) : 0.);
    LinearReport report;
    if (at.z.any())
      {
        if (dz_.size() == 0)
          dz_ = lift_z_ = right_z_ = problem.linearisation().local()->make_local();
        problem.local_residual(right_z_);
        if (open)
          right_z_ += lift_z_;
        right_z_ *= -1;
        // the verdict is that of z(x): the solve that may be the last counts the residual of z as it does
        const bool      last = goal * at.norm <= 2 * absolute;
        const double    size = std::max(at.norm, std::numeric_limits<double>::min());
        const LocalPart local{right_z_, dz_, size, last};
        report = solver.solve(problem, right_, dx, last ? absolute / size : goal, enough, &local);
        dz_.update_ghost_values();
      }
    else
      report = solver.solve(problem, right_, dx, std::max(goal, tightest), enough, nullptr);
    free_.distribute(dx);
    if (open)
      dx += gap_; // the solve was for the free unknowns; the others go straight to their targets
    return report;
  }

  double LiftedFunction::curvature(NonlinearProblem &problem, const Iterate &at, const Vector &dx)
  {
    linearise(problem, at);
    right_ = dx;
    if (at.remaining != 0)
      right_ -= gap_; // dq alone
    right_.update_ghost_values();
    if (at.z.any())
      problem.linearisation().local()->apply_with_local(problem.weights(), LocalEquations::Digits::single, right_, dz_, true_, right_z_);
    else
      problem.linearisation().apply(problem.weights(), right_, true_);
    free_.condense(true_);
    return right_ * true_;
  }

  double LiftedFunction::true_norm(NonlinearProblem &problem, const Iterate &at, Evaluation &evaluation)
  {
    evaluation = at.evaluation;
    if (!at.z.any())
      return at.norm;
    evaluation = problem.residual(at.x, true_);
    if (!evaluation.admissible)
      return std::numeric_limits<double>::infinity();
    free_.condense(true_);
    return norm_or_nan(true_);
  }
} // namespace myolines
