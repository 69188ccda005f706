// SPDX-License-Identifier: LGPL-2.1-or-later
#include "newton.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  Newton::Options::Options(const scene::Node &node)
    : relative_tolerance(node.number("relative tolerance"))
    , maximum_iterations(node.integer("maximum iterations"))
    , maximum_cuts(node.integer("line search cuts"))
    , forcing_minimum(node.number("forcing minimum"))
    , forcing_maximum(node.number("forcing maximum"))
  {
    if (node.has("absolute tolerance"))
      absolute_tolerance = node.number("absolute tolerance");
    if (forcing_minimum > forcing_maximum)
      node.refuse("forcing minimum", "is larger than \"forcing maximum\"", "forcing minimum <= forcing maximum");
  }

  Newton::Newton(const Options &options, NonlinearProblem &problem, LiftedFunction &function, DirectionSolver &solver, WorkLedger &ledger,
                 const StopRequest &stop)
    : options_(options)
    , problem_(problem)
    , function_(function)
    , solver_(solver)
    , ledger_(ledger)
    , stop_(stop)
  {}

  /// Of problems that do not tell the size of their forces, as of linear ones, the tolerance is relative to where the solve began.
  double Newton::tolerance(const Evaluation &evaluation) const
  {
    constexpr double units    = 16;                              // of rounding, as the resolution of a stage
    const bool       unit     = problem_.has_unit_of_residual(); // or a problem without forces of its own
    const bool       sized    = unit && (evaluation.forces > 0 || evaluation.rounding > 0);
    const double     absolute = unit ? options_.absolute_tolerance.value_or(sized ? 0 : 1e-10) : 0;
    return std::max(
        {options_.relative_tolerance * (sized ? evaluation.forces : report_.initial_residual), absolute, units * evaluation.rounding});
  }

  bool Newton::begin(Iterate &at)
  {
    ledger_.count("nonlinear solves");
    function_.first(problem_, !solver_.exact(), at); // small problems do well without other rates
    report_.initial_residual = at.norm;
    if (at.evaluation.admissible)
      return true;
    report_.reason       = "the first guess is inadmissible (" + at.evaluation.reason + ")";
    report_.inadmissible = true;
    if (at.undefined)
      {
        report_.advice        = "loads and motions that are defined at all times of the run";
        report_.shorter_steps = false;
      }
    return false;
  }

  Newton::Verdict Newton::judge(const Iterate &at)
  {
    report_.final_residual = at.norm;
    const bool last        = report_.iterations >= options_.maximum_iterations;
    Evaluation evaluation  = at.evaluation;
    // F(x, z(x)) is worth a look once F(x, z) is nearly small enough
    constexpr double nearly = 1e3;
    if (at.remaining == 0 && (last || at.norm <= nearly * tolerance(evaluation)))
      {
        report_.final_residual = function_.true_norm(problem_, at, evaluation);
        report_.converged      = report_.final_residual <= tolerance(evaluation);
      }
    if (at.remaining == 0 && report_.iterations > 0)
      report_.converged = report_.converged || below_resolution_ || (problem_.affine() && solver_.exact()) || steps_.enough();
    if (report_.converged)
      return Verdict::converged;
    if (stop_())
      {
        report_.reason = "the run is asked to stop";
        return Verdict::failed;
      }
    if (!last)
      return Verdict::go_on;
    std::ostringstream text;
    text << "residual " << report_.final_residual << " above the tolerance " << tolerance(evaluation) << " after " << report_.iterations
         << " Newton iterations";
    report_.reason = text.str();
    report_.advice = "more \"solver/nonlinear/maximum iterations\"";
    if (at_rounding(evaluation))
      advise_looser_tolerance(evaluation);
    return Verdict::failed;
  }

  /// An inexact direction that reduces the linear residual is still a good one: the line search judges it. What a solve leaves below half
  /// the tolerance nobody needs (Kelley, Iterative Methods for Linear and Nonlinear Equations, doi:10.1137/1.9781611970944, 6.3).
  bool Newton::direction(Iterate &at, const double forcing, Vector &dx)
  {
    const LinearReport linear = function_.direction(problem_, solver_, at, forcing, 0.5 * tolerance(at.evaluation), dx);
    ++report_.iterations;
    ledger_.count("newton iterations");
    report_.linear_iterations += linear.iterations;
    below_resolution_ = at.remaining == 0 && dx.linfty_norm() <= problem_.resolution();
    if (linear.converged || linear.relative_residual < 0.5)
      return true;
    report_.reason = "linear solver: " + linear.reason;
    if (!note_indefinite_tangent(at, dx))
      report_.advice = "more \"solver/linear/maximum iterations\" or another \"solver/preconditioner/type\"";
    return false;
  }

  /// There equilibria lose their stability, as at limit points, and neither line search nor Krylov iterations get on.
  bool Newton::note_indefinite_tangent(const Iterate &at, const Vector &dx)
  {
    if (!(function_.curvature(problem_, at, dx) < 0))
      return false;
    report_.reason += "; the tangent is indefinite there";
    return true;
  }

  namespace
  {
    /// Minimiser of the parabola through |G|^2 at 0 (with slope -2 |G_0|^2) and at alpha, relative to alpha.
    double shrink(const double norm0, const double norm, const double alpha)
    {
      const double phi0      = norm0 * norm0;
      const double curvature = norm * norm - phi0 + 2 * alpha * phi0;
      return std::clamp(alpha * phi0 / curvature, 0.1, 0.5);
    }
  } // namespace

  std::optional<double> Newton::search(const Iterate &from, const Vector &dx, Iterate &to)
  {
    const bool accept_any = below_resolution_ || (problem_.affine() && solver_.exact());
    double     alpha      = 1;
    for (unsigned int cut = 0;; ++cut)
      {
        function_.move(problem_, from, dx, alpha, to);
        const bool valid = to.evaluation.admissible;
        if (valid && (accept_any || (to.remaining == 0 && to.norm <= tolerance(to.evaluation)) || lowers(from, alpha, to)))
          {
            steps_.taken(cut == 0 ? problem_.importance(dx) : std::nullopt);
            return alpha;
          }
        if (cut == std::min(options_.maximum_cuts, problem_.most_cuts()))
          {
            fail_search(from, dx, to, cut, alpha);
            return std::nullopt;
          }
        ledger_.count("line search cuts");
        alpha *= valid ? shrink(from.norm, to.norm, alpha) : 0.5;
      }
  }

  /// Residuals rise along good steps where forces across them are large: a slender body that turns is stretched to second order, which
  /// costs far more force than its bending. Full steps are taken all the same, in the hope that the next ones make up for it.
  bool Newton::lowers(const Iterate &from, const double alpha, const Iterate &to)
  {
    const double before = waited_ > 0 ? lowest_ : from.norm;
    if (to.norm <= (1 - 1e-4 * alpha) * before)
      {
        waited_ = 0;
        return true;
      }
    if (waited_ >= problem_.patience())
      return false;
    waited_ += alpha < 1 ? 4 : 1; // a step that had to be shortened promises less
    lowest_ = before;
    return true;
  }

  void Newton::fail_search(const Iterate &from, const Vector &dx, const Iterate &trial, const unsigned int cuts, const double alpha)
  {
    std::ostringstream text;
    text << "line search: after " << cuts << " cuts, at " << alpha << " of the Newton step, ";
    if (trial.evaluation.admissible)
      text << "the residual is " << trial.norm << " and was " << from.norm;
    else
      text << "the state is inadmissible (" << trial.evaluation.reason << ")";
    report_.reason       = text.str();
    report_.inadmissible = !trial.evaluation.admissible;
    if (trial.evaluation.admissible && at_rounding(from.evaluation))
      advise_looser_tolerance(from.evaluation);
    else
      note_indefinite_tangent(from, dx);
  }

  /// Whether the last residual is near what rounding leaves.
  bool Newton::at_rounding(const Evaluation &evaluation) const { return report_.final_residual <= 1e3 * evaluation.rounding; }

  void Newton::advise_looser_tolerance(const Evaluation &evaluation)
  {
    std::ostringstream text;
    text << "a larger \"solver/nonlinear/relative tolerance\" (the rounding of displacements leaves a residual of about "
         << evaluation.rounding << ", the forces are " << evaluation.forces << ") or a smaller bulk modulus";
    report_.advice        = text.str();
    report_.shorter_steps = false;
  }

  void Newton::fail(const std::string &reason)
  {
    report_.converged = false;
    report_.reason    = reason;
  }

  const NonlinearReport &Newton::report()
  {
    report_.residual_evaluations = function_.evaluations();
    return report_;
  }
} // namespace myolines
