#include "nox_group.h"

#include <myolines/solve/band_newton.h>
#include <myolines/solve/newton_steps.h>
#include <myolines/solve/nonlinear_solver.h>

#include <NOX_GlobalData.H>
#include <NOX_LineSearch_Generic.H>
#include <NOX_LineSearch_UserDefinedFactory.H>
#include <NOX_Solver_Factory.H>
#include <Teuchos_oblackholestream.hpp>

#include <cmath>

namespace myolines
{
  namespace
  {
    const LiftedFunction::Sample &sample_of(const NOX::Abstract::Group &group) { return dynamic_cast<const NoxGroup &>(group).sample(); }

    /// Residual backtracking; see the class comment of NonlinearSolver.
    class Backtracking : public NOX::LineSearch::Generic
    {
    public:
      explicit Backtracking(NoxSolve &solve)
        : solve_(solve)
      {}

      bool compute(NOX::Abstract::Group &group, double &step, const NOX::Abstract::Vector &direction,
                   const NOX::Solver::Generic &solver) override
      {
        const NOX::Abstract::Group &old   = solver.getPreviousSolutionGroup();
        const double                norm0 = old.getNormF();
        const double                goal  = patient_steps_ > 0 ? goal_ : norm0;

        double alpha = 1;
        for (unsigned int cut = 0;; ++cut)
          {
            group.computeX(old, direction, alpha);
            group.computeF();
            const LiftedFunction::Sample &trial = sample_of(group);
            const bool                    valid = trial.evaluation.admissible;
            step                                = alpha;
            if (valid && (trial.norm <= (1 - 1e-4 * alpha) * goal || (trial.remaining == 0 && trial.norm <= solve_.tolerance())))
              {
                patient_steps_ = 0;
                solve_.steps.taken(cut == 0 ? solve_.problem.importance(NoxVector::of(direction)) : std::nullopt);
                return true;
              }
            if (valid && cut == 0 && patient_steps_ < solve_.patience && trial.norm <= solve_.patience_growth * goal)
              {
                goal_              = goal;
                solve_.was_patient = true;
                ++patient_steps_;
                solve_.steps.taken(std::nullopt);
                return true;
              }
            if (cut == solve_.maximum_cuts || patient_steps_ > 0)
              {
                fail(trial, norm0, cut, alpha);
                step = 0;
                return false;
              }
            solve_.ledger.count("line search cuts");
            alpha *= valid ? shrink(norm0, trial.norm, alpha) : 0.5;
          }
      }

    private:
      /// Minimiser of the parabola through |G|^2 at 0 (with slope -2 |G_0|^2) and at alpha, relative to alpha.
      static double shrink(const double norm0, const double norm, const double alpha)
      {
        const double phi0      = norm0 * norm0;
        const double curvature = norm * norm - phi0 + 2 * alpha * phi0;
        return std::clamp(alpha * phi0 / curvature, 0.1, 0.5);
      }

      void fail(const LiftedFunction::Sample &trial, const double norm0, const unsigned int cuts, const double alpha)
      {
        std::ostringstream text;
        text << "line search: after " << cuts << " cuts, at " << alpha << " of the Newton step, ";
        if (trial.evaluation.admissible)
          text << "the residual is " << trial.norm << " and was " << norm0;
        else
          text << "the state is inadmissible (" << trial.evaluation.reason << ")";
        solve_.reason       = text.str();
        solve_.inadmissible = !trial.evaluation.admissible;
      }

      NoxSolve    &solve_;
      unsigned int patient_steps_ = 0; ///< so far in a row
      double       goal_          = 0; ///< |G| before them
    };

    class BacktrackingFactory : public NOX::LineSearch::UserDefinedFactory
    {
    public:
      explicit BacktrackingFactory(NoxSolve &solve)
        : solve_(solve)
      {}
      Teuchos::RCP<NOX::LineSearch::Generic> buildLineSearch(const Teuchos::RCP<NOX::GlobalData> &, Teuchos::ParameterList &) const override
      {
        return Teuchos::rcp(new Backtracking(solve_));
      }

    private:
      NoxSolve &solve_;
    };

    class Verdict : public NOX::StatusTest::Generic
    {
    public:
      explicit Verdict(NoxSolve &solve)
        : solve_(solve)
      {}

      NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic &solver, NOX::StatusTest::CheckType) override
      {
        const LiftedFunction::Sample &sample     = sample_of(solver.getSolutionGroup());
        const auto                    iterations = static_cast<unsigned int>(solver.getNumIterations());
        if (iterations == 0)
          solve_.initial_norm = sample.norm;
        status_ = NOX::StatusTest::Unconverged;
        if (sample.remaining == 0 && (sample.norm <= solve_.tolerance() || solve_.steps.enough()))
          status_ = NOX::StatusTest::Converged;
        else if (iterations >= solve_.maximum_iterations)
          {
            std::ostringstream text;
            text << "residual " << sample.norm << " above the tolerance " << solve_.tolerance() << " after " << iterations
                 << " Newton iterations";
            solve_.reason = text.str();
            status_       = NOX::StatusTest::Failed;
          }
        return status_;
      }

      NOX::StatusTest::StatusType getStatus() const override { return status_; }
      std::ostream               &print(std::ostream &stream, int) const override { return stream; }

    private:
      NoxSolve                   &solve_;
      NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
    };
  } // namespace

  scene::Schema NonlinearSolver::schema()
  {
    using scene::Range;
    const Range   fraction{0, 1, true, true};
    scene::Schema schema("Newton's method for the implicit stages.");
    schema.number("relative tolerance", 1e-8, "-", fraction, "Converged when the residual has fallen by this factor.")
        .number("absolute tolerance", 1e-10, "unit of the residual", Range::not_negative(),
                "Converged when the residual norm is below this.")
        .integer("maximum iterations", 25, Range::closed(1, 1000), "Largest number of Newton steps.")
        .integer("line search cuts", 6, Range::closed(0, 50), "Largest number of times one Newton step is shortened.")
        .integer("patience", 2, Range::closed(0, 10),
                 "Newton steps in a row that may raise the residual before one ends below where it was; if none does, the solve begins "
                 "anew without patience.")
        .number("patience growth", 10, "-", Range::positive(),
                "Factor that they may raise it by; hundreds and more where the bulk modulus is thousands of times the shear modulus.")
        .number("forcing minimum", 1e-4, "-", fraction, "Tightest relative tolerance of the linear solves.")
        .number("forcing maximum", 1e-2, "-", fraction, "Loosest relative tolerance of the linear solves, and that of the first one.");
    return schema;
  }

  class NonlinearSolver::Implementation
  {
  public:
    Implementation(const scene::Node &node, LinearSolver &linear, WorkLedger &ledger)
      : node_(node)
      , linear_(linear)
      , ledger_(ledger)
      , band_newton_(node, ledger)
    {
      if (node.number("forcing minimum") > node.number("forcing maximum"))
        node.refuse("forcing minimum", "is larger than \"forcing maximum\"", "forcing minimum <= forcing maximum");
    }

    NonlinearReport solve(NonlinearProblem &problem, Vector &x);
    void            forget() { linear_.forget(), band_newton_.forget(); }

  private:
    Teuchos::RCP<Teuchos::ParameterList> parameters(NoxSolve &solve) const;
    bool                                 attempt(NonlinearProblem &problem, Vector &x, unsigned int patience, NonlinearReport &report);
    void                                 run(NoxSolve &solve, const Teuchos::RCP<NoxGroup> &group, NonlinearReport &report);

    const scene::Node node_;
    LinearSolver     &linear_;
    WorkLedger       &ledger_;
    BandNewton        band_newton_;
  };

  Teuchos::RCP<Teuchos::ParameterList> NonlinearSolver::Implementation::parameters(NoxSolve &solve) const
  {
    const auto list = Teuchos::rcp(new Teuchos::ParameterList);
    list->set("Nonlinear Solver", "Line Search Based");
    Teuchos::ParameterList &printing = list->sublist("Printing");
    printing.set("Output Information", 0);
    printing.set<Teuchos::RCP<std::ostream>>("Output Stream", Teuchos::rcp(new Teuchos::oblackholestream)); // some messages ask nobody
    printing.set<Teuchos::RCP<std::ostream>>("Error Stream", Teuchos::rcp(new Teuchos::oblackholestream));
    Teuchos::ParameterList &direction = list->sublist("Direction");
    direction.set("Method", "Newton");
    Teuchos::ParameterList &newton = direction.sublist("Newton");
    newton.set("Rescue Bad Newton Solve", false);
    newton.set("Forcing Term Method", "Type 2");
    newton.set("Forcing Term Initial Tolerance", node_.number("forcing maximum"));
    newton.set("Forcing Term Minimum Tolerance", node_.number("forcing minimum"));
    newton.set("Forcing Term Maximum Tolerance", node_.number("forcing maximum"));
    Teuchos::ParameterList &search = list->sublist("Line Search");
    search.set("Method", "User Defined");
    search.set<Teuchos::RCP<NOX::LineSearch::UserDefinedFactory>>("User Defined Line Search Factory",
                                                                  Teuchos::rcp(new BacktrackingFactory(solve)));
    return list;
  }

  void NonlinearSolver::Implementation::run(NoxSolve &solve, const Teuchos::RCP<NoxGroup> &group, NonlinearReport &report)
  {
    // NOX throws a plain text where F cannot be computed: look at the first point ourselves.
    if (group->computeF() != NOX::Abstract::Group::Ok)
      {
        solve.reason       = "the first guess is inadmissible (" + group->sample().evaluation.reason + ")";
        solve.inadmissible = true;
        return;
      }
    const auto solver = NOX::Solver::buildSolver(group, Teuchos::rcp(new Verdict(solve)), parameters(solve));
    report.converged  = solver->solve() == NOX::StatusTest::Converged;
  }

  bool NonlinearSolver::Implementation::attempt(NonlinearProblem &problem, Vector &x, const unsigned int patience, NonlinearReport &report)
  {
    NoxSolve   solve{problem,
                   LiftedFunction(problem, linear_, ledger_, x),
                   ledger_,
                   node_.number("relative tolerance"),
                   problem.has_unit_of_residual() ? node_.number("absolute tolerance") : 0,
                   static_cast<unsigned int>(node_.integer("maximum iterations")),
                   static_cast<unsigned int>(node_.integer("line search cuts")),
                   patience,
                   node_.number("patience growth")};
    const auto group = Teuchos::rcp(new NoxGroup(solve, x));
    try
      {
        run(solve, group, report);
      }
    catch (const std::exception &error)
      {
        if (solve.reason.empty())
          solve.reason = error.what();
      }
    catch (const char *text)
      {
        if (solve.reason.empty())
          solve.reason = text;
      }
    x = NoxVector::of(group->getX());

    report.reason       = report.converged ? "" : solve.reason.empty() ? "Newton's method failed" : solve.reason;
    report.inadmissible = solve.inadmissible;
    report.iterations += solve.iterations;
    report.linear_iterations += solve.linear_iterations;
    report.residual_evaluations += solve.function.evaluations();
    report.initial_residual = solve.initial_norm;
    report.final_residual   = group->getNormF();
    return report.converged || !solve.was_patient;
  }

  NonlinearReport NonlinearSolver::Implementation::solve(NonlinearProblem &problem, Vector &x)
  {
    if (auto *bands = dynamic_cast<BandLinearisation *>(&problem.linearisation()); bands != nullptr && linear_.automatic())
      return band_newton_.solve(problem, *bands, x);
    ledger_.count("nonlinear solves");
    linear_.new_step();
    x.update_ghost_values();
    const auto      patience = static_cast<unsigned int>(node_.integer("patience"));
    const Vector    guess(x);
    NonlinearReport report;
    if (!attempt(problem, x, patience, report))
      {
        ledger_.count("nonlinear solves begun anew");
        linear_.new_step();
        x = guess;
        attempt(problem, x, 0, report);
      }
    return report;
  }

  NonlinearSolver::NonlinearSolver(const scene::Node &nonlinear, LinearSolver &linear, WorkLedger &ledger)
    : implementation_(std::make_unique<Implementation>(nonlinear, linear, ledger))
  {}

  NonlinearSolver::~NonlinearSolver() = default;

  NonlinearReport NonlinearSolver::solve(NonlinearProblem &problem, Vector &x) { return implementation_->solve(problem, x); }

  void NonlinearSolver::forget() { implementation_->forget(); }
} // namespace myolines
