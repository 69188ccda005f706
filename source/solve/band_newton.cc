#include <myolines/solve/band_newton.h>
#include <myolines/solve/newton_steps.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace myolines
{
  namespace
  {
    bool same(const double left, const double right) { return std::abs(left - right) <= 1e-10 * std::abs(left); }

    /// Equal up to the rounding of step sizes, which are differences of instants; far below the tolerances of the solver.
    bool same(const WeightsByOrder &left, const WeightsByOrder &right)
    {
      return std::equal(left.begin(), left.end(), right.begin(),
                        [](const Weights &a, const Weights &b) { return same(a.u, b.u) && same(a.v, b.v) && same(a.a, b.a); });
    }
  } // namespace

  BandNewton::BandNewton(const scene::Node &nonlinear, WorkLedger &ledger)
    : relative_tolerance_(nonlinear.number("relative tolerance"))
    , absolute_tolerance_(nonlinear.number("absolute tolerance"))
    , maximum_iterations_(nonlinear.integer("maximum iterations"))
    , line_search_cuts_(nonlinear.integer("line search cuts"))
    , ledger_(ledger)
  {}

  void BandNewton::allocate(const NonlinearProblem &problem, const Vector &x)
  {
    if (constraints_ == &problem.constraints() && g_.size() == x.size())
      return;
    constraints_ = &problem.constraints();
    free_.emplace(*constraints_, x);
    for (Vector *v : {&g_, &gap_, &lift_, &direction_, &trial_})
      *v = x;
    factored_.reset();
    matrix_.reset();
  }

  bool BandNewton::factorise(NonlinearProblem &problem, BandLinearisation &bands)
  {
    if (factored_ && factored_->bands == &bands && factored_->version == bands.version() && same(factored_->weights, problem.weights()))
      return true;
    const WorkLedger::Timer timer(ledger_, "factorisation");
    ledger_.count("preconditioner set-ups");
    if (!matrix_ || matrix_->bandwidth() != std::min<std::size_t>(bands.bandwidth(), g_.size() - 1))
      matrix_.emplace(g_.size(), bands.bandwidth());
    factored_.reset();
    bands.fill(problem.weights(), *matrix_);
    if (!matrix_->factorise())
      return false;
    factored_ = Factored{&bands, bands.version(), problem.weights()};
    return true;
  }

  double BandNewton::norm(const Vector &x) const
  {
    double sum = 0;
    for (const double entry : x)
      sum += entry * entry;
    return std::sqrt(sum);
  }

  /// g_ = C^T F(x) + remaining lift_, and its norm; NaN where inadmissible.
  double BandNewton::evaluate(NonlinearProblem &problem, const Vector &x, const double remaining, Evaluation &evaluation,
                              NonlinearReport &report)
  {
    ++report.residual_evaluations;
    evaluation = problem.residual(x, g_);
    if (!evaluation.admissible)
      return std::numeric_limits<double>::quiet_NaN();
    free_->condense(g_);
    if (remaining != 0)
      for (unsigned int i = 0; i < g_.size(); ++i)
        g_.local_element(i) += remaining * lift_.local_element(i);
    const double result = norm(g_);
    if (!std::isfinite(result))
      evaluation = {false, "the residual is not a finite number"};
    return result;
  }

  /// gap_ = target - x on constrained unknowns, zero on free ones.
  void BandNewton::set_gap(NonlinearProblem &problem, const Vector &x)
  {
    std::copy(x.begin(), x.end(), gap_.begin());
    problem.impose(gap_);
    for (unsigned int i = 0; i < x.size(); ++i)
      gap_.local_element(i) -= x.local_element(i);
  }

  void BandNewton::add_lift(NonlinearProblem &problem, BandLinearisation &bands)
  {
    bands.apply(problem.weights(), gap_, lift_);
    free_->condense(lift_);
    for (unsigned int i = 0; i < g_.size(); ++i)
      g_.local_element(i) += lift_.local_element(i);
    norm_ = norm(g_);
  }

  NonlinearReport BandNewton::solve(NonlinearProblem &problem, BandLinearisation &bands, Vector &x)
  {
    NonlinearReport report;
    Evaluation      evaluation;
    ledger_.count("nonlinear solves");
    allocate(problem, x);

    set_gap(problem, x);
    double remaining = gap_.linfty_norm() > problem.resolution() ? 1 : 0;
    if (remaining == 0)
      problem.impose(x); // the rest is rounding
    norm_ = evaluate(problem, x, 0, evaluation, report);
    if (!evaluation.admissible)
      {
        report.reason       = "the first guess is inadmissible (" + evaluation.reason + ")";
        report.inadmissible = true;
        return report;
      }
    bool        linearised = false;
    NewtonSteps steps;
    if (remaining != 0)
      {
        problem.linearise(x);
        linearised = true;
        add_lift(problem, bands);
      }
    report.initial_residual = norm_;
    const double tolerance  = std::max(relative_tolerance_ * norm_, problem.has_unit_of_residual() ? absolute_tolerance_ : 0);

    for (;; linearised = false)
      {
        report.final_residual = norm_;
        if (remaining == 0 && (norm_ <= tolerance || (report.iterations > 0 && problem.affine()) || steps.enough()))
          {
            report.converged = true;
            return report;
          }
        if (report.iterations == maximum_iterations_)
          {
            std::ostringstream text;
            text << "residual " << norm_ << " above the tolerance " << tolerance << " after " << report.iterations << " Newton iterations";
            report.reason = text.str();
            return report;
          }
        if (!linearised)
          {
            problem.linearise(x);
            if (remaining != 0) // what a damped step has left is lifted anew from here
              {
                for (unsigned int i = 0; i < g_.size(); ++i)
                  g_.local_element(i) -= remaining * lift_.local_element(i);
                set_gap(problem, x);
                add_lift(problem, bands);
                remaining = 1;
              }
          }
        ++report.iterations;
        ++report.linear_iterations;
        ledger_.count("newton iterations");
        ledger_.count("linear solves");
        ledger_.count("linear iterations");
        if (!factorise(problem, bands))
          {
            report.reason = "linear solver: the matrix is singular";
            return report;
          }
        for (unsigned int i = 0; i < g_.size(); ++i)
          direction_.local_element(i) = -g_.local_element(i);
        {
          const WorkLedger::Timer timer(ledger_, "band solve");
          matrix_->solve(direction_.begin());
        }
        free_->distribute(direction_);
        if (remaining == 0 && direction_.linfty_norm() <= problem.resolution())
          {
            report.converged = true;
            return report;
          }
        if (remaining != 0)
          for (unsigned int i = 0; i < g_.size(); ++i)
            direction_.local_element(i) += gap_.local_element(i);
        const std::optional<double> part = search(problem, x, remaining, tolerance, report);
        if (!part)
          return report;
        steps.taken(*part == 1 ? problem.importance(direction_) : std::nullopt);
      }
  }

  /// Residual backtracking, see the class comment of NonlinearSolver. The part of the step that was taken, or none.
  std::optional<double> BandNewton::search(NonlinearProblem &problem, Vector &x, double &remaining, const double tolerance,
                                           NonlinearReport &report)
  {
    const double norm0 = norm_, open = remaining;
    double       alpha = 1;
    for (unsigned int cut = 0;; ++cut)
      {
        for (unsigned int i = 0; i < x.size(); ++i)
          trial_.local_element(i) = x.local_element(i) + alpha * direction_.local_element(i);
        remaining = (1 - alpha) * open;
        if (remaining == 0)
          problem.impose(trial_);
        Evaluation evaluation;
        norm_ = evaluate(problem, trial_, remaining, evaluation, report);
        if (evaluation.admissible && (problem.affine() || norm_ <= (1 - 1e-4 * alpha) * norm0 || (remaining == 0 && norm_ <= tolerance)))
          {
            x.swap(trial_);
            return alpha;
          }
        if (cut == line_search_cuts_)
          {
            std::ostringstream text;
            text << "line search: after " << cut << " cuts, at " << alpha << " of the Newton step, ";
            if (evaluation.admissible)
              text << "the residual is " << norm_ << " and was " << norm0;
            else
              text << "the state is inadmissible (" << evaluation.reason << ")";
            report.reason       = text.str();
            report.inadmissible = !evaluation.admissible;
            return std::nullopt;
          }
        ledger_.count("line search cuts");
        // the minimiser of the parabola through |G|^2 at 0, with slope -2 |G_0|^2, and at alpha
        const double phi0 = norm0 * norm0;
        alpha *= evaluation.admissible ? std::clamp(alpha * phi0 / (norm_ * norm_ - phi0 + 2 * alpha * phi0), 0.1, 0.5) : 0.5;
      }
  }
} // namespace myolines
