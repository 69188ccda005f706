#include "nox_vector.h"

#include <myolines/solve/band_newton.h>
#include <myolines/solve/lifted_function.h>
#include <myolines/solve/newton_steps.h>
#include <myolines/solve/nonlinear_solver.h>

#include <NOX.H>
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
    /// What the parts of one solve share.
    struct Solve
    {
      NonlinearProblem &problem;
      LiftedFunction    function;
      WorkLedger       &ledger;
      double            relative_tolerance;
      double            absolute_tolerance;
      unsigned int      maximum_iterations;
      unsigned int      maximum_cuts;

      std::string  reason            = {};
      bool         inadmissible      = false;
      unsigned int iterations        = 0;
      unsigned int linear_iterations = 0;
      double       initial_norm      = 0;
      NewtonSteps  steps             = {};

      double tolerance() const { return std::max(relative_tolerance * initial_norm, absolute_tolerance); }
    };

    /// A point, G there and the Newton direction.
    class NoxGroup : public NOX::Abstract::Group
    {
    public:
      NoxGroup(Solve &solve, const Vector &x)
        : solve_(solve)
        , x_(x)
        , g_(x)
        , direction_(x)
      {
        moved(1);
      }

      NOX::Abstract::Group &operator=(const NOX::Abstract::Group &other) override
      {
        const auto &from  = dynamic_cast<const NoxGroup &>(other);
        x_.values         = from.x_.values;
        g_.values         = from.g_.values;
        direction_.values = from.direction_.values;
        sample_           = from.sample_;
        first_            = from.first_;
        evaluated_        = from.evaluated_;
        has_direction_    = from.has_direction_;
        return *this;
      }

      void setX(const NOX::Abstract::Vector &x) override
      {
        x_ = x;
        moved(1);
      }

      void computeX(const NOX::Abstract::Group &from, const NOX::Abstract::Vector &direction, const double step) override
      {
        const auto  &origin    = dynamic_cast<const NoxGroup &>(from);
        const double remaining = (1 - step) * origin.sample_.remaining;
        x_.values              = origin.x_.values;
        x_.values.add(step, NoxVector::of(direction));
        if (remaining == 0)
          solve_.function.impose(x_.values);
        x_.values.update_ghost_values();
        moved(remaining);
        first_ = false;
      }

      ReturnType computeF() override
      {
        if (!evaluated_)
          sample_ = first_ ? solve_.function.first(x_.values, sample_.stamp, g_.values)
                           : solve_.function.evaluate(x_.values, sample_.stamp, sample_.remaining, g_.values);
        evaluated_ = true;
        return sample_.evaluation.admissible ? Ok : Failed;
      }

      ReturnType computeJacobian() override { return evaluated_ ? Ok : BadDependency; }

      /// An inexact direction that reduces the linear residual is still a good one: the line search judges it.
      ReturnType computeNewton(Teuchos::ParameterList &list) override
      {
        if (has_direction_)
          return Ok;
        const LinearReport report =
            solve_.function.direction(x_.values, sample_, g_.values, list.get<double>("Tolerance"), direction_.values);
        ++solve_.iterations;
        solve_.ledger.count("newton iterations");
        solve_.linear_iterations += report.iterations;
        has_direction_ = report.converged || report.relative_residual < 0.5;
        if (!has_direction_)
          solve_.reason = "linear solver: " + report.reason;
        return has_direction_ ? Ok : Failed;
      }

      bool isF() const override { return evaluated_; }
      bool isJacobian() const override { return evaluated_; }
      bool isNewton() const override { return has_direction_; }

      const NOX::Abstract::Vector &getX() const override { return x_; }
      const NOX::Abstract::Vector &getF() const override { return g_; }
      double                       getNormF() const override { return sample_.norm; }
      const NOX::Abstract::Vector &getNewton() const override { return direction_; }
      /// The gradient of |G|^2 / 2 needs J^T; nothing here asks for it.
      const NOX::Abstract::Vector &getGradient() const override { throw std::logic_error("the Newton group has no gradient"); }

      Teuchos::RCP<const NOX::Abstract::Vector> getXPtr() const override { return Teuchos::rcpFromRef(x_); }
      Teuchos::RCP<const NOX::Abstract::Vector> getFPtr() const override { return Teuchos::rcpFromRef(g_); }
      Teuchos::RCP<const NOX::Abstract::Vector> getNewtonPtr() const override { return Teuchos::rcpFromRef(direction_); }
      Teuchos::RCP<const NOX::Abstract::Vector> getGradientPtr() const override { return Teuchos::rcpFromRef(getGradient()); }

      Teuchos::RCP<NOX::Abstract::Group> clone(NOX::CopyType) const override { return Teuchos::rcp(new NoxGroup(*this)); }

      const LiftedFunction::Sample &sample() const { return sample_; }

    private:
      void moved(const double remaining)
      {
        sample_           = {};
        sample_.stamp     = solve_.function.new_stamp();
        sample_.remaining = remaining;
        first_            = true;
        evaluated_        = false;
        has_direction_    = false;
      }

      Solve                 &solve_;
      NoxVector              x_;
      NoxVector              g_;
      NoxVector              direction_;
      LiftedFunction::Sample sample_;
      bool                   first_         = true; ///< x was given, not reached by a step
      bool                   evaluated_     = false;
      bool                   has_direction_ = false;
    };

    const LiftedFunction::Sample &sample_of(const NOX::Abstract::Group &group) { return dynamic_cast<const NoxGroup &>(group).sample(); }

    /// Residual backtracking; see the class comment of NonlinearSolver.
    class Backtracking : public NOX::LineSearch::Generic
    {
    public:
      explicit Backtracking(Solve &solve)
        : solve_(solve)
      {}

      bool compute(NOX::Abstract::Group &group, double &step, const NOX::Abstract::Vector &direction,
                   const NOX::Solver::Generic &solver) override
      {
        const NOX::Abstract::Group &old   = solver.getPreviousSolutionGroup();
        const double                norm0 = old.getNormF();

        double alpha = 1;
        for (unsigned int cut = 0;; ++cut)
          {
            group.computeX(old, direction, alpha);
            group.computeF();
            const LiftedFunction::Sample &trial = sample_of(group);
            const bool                    valid = trial.evaluation.admissible;
            if (valid && (trial.norm <= (1 - 1e-4 * alpha) * norm0 || (trial.remaining == 0 && trial.norm <= solve_.tolerance())))
              {
                step = alpha;
                solve_.steps.taken(cut == 0 ? solve_.problem.importance(NoxVector::of(direction)) : std::nullopt);
                return true;
              }
            if (cut == solve_.maximum_cuts)
              {
                fail(trial, norm0, alpha);
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

      void fail(const LiftedFunction::Sample &trial, const double norm0, const double alpha)
      {
        std::ostringstream text;
        text << "line search: after " << solve_.maximum_cuts << " cuts, at " << alpha << " of the Newton step, ";
        if (trial.evaluation.admissible)
          text << "the residual is " << trial.norm << " and was " << norm0;
        else
          text << "the state is inadmissible (" << trial.evaluation.reason << ")";
        solve_.reason       = text.str();
        solve_.inadmissible = !trial.evaluation.admissible;
      }

      Solve &solve_;
    };

    class BacktrackingFactory : public NOX::LineSearch::UserDefinedFactory
    {
    public:
      explicit BacktrackingFactory(Solve &solve)
        : solve_(solve)
      {}
      Teuchos::RCP<NOX::LineSearch::Generic> buildLineSearch(const Teuchos::RCP<NOX::GlobalData> &, Teuchos::ParameterList &) const override
      {
        return Teuchos::rcp(new Backtracking(solve_));
      }

    private:
      Solve &solve_;
    };

    class Verdict : public NOX::StatusTest::Generic
    {
    public:
      explicit Verdict(Solve &solve)
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
      Solve                      &solve_;
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
    Teuchos::RCP<Teuchos::ParameterList> parameters(Solve &solve) const;
    void                                 run(Solve &solve, const Teuchos::RCP<NoxGroup> &group, NonlinearReport &report);

    const scene::Node node_;
    LinearSolver     &linear_;
    WorkLedger       &ledger_;
    BandNewton        band_newton_;
  };

  Teuchos::RCP<Teuchos::ParameterList> NonlinearSolver::Implementation::parameters(Solve &solve) const
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

  void NonlinearSolver::Implementation::run(Solve &solve, const Teuchos::RCP<NoxGroup> &group, NonlinearReport &report)
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

  NonlinearReport NonlinearSolver::Implementation::solve(NonlinearProblem &problem, Vector &x)
  {
    if (auto *bands = dynamic_cast<BandLinearisation *>(&problem.linearisation()); bands != nullptr && linear_.automatic())
      return band_newton_.solve(problem, *bands, x);
    ledger_.count("nonlinear solves");
    linear_.new_step();
    x.update_ghost_values();
    Solve           solve{problem,
                LiftedFunction(problem, linear_, ledger_, x),
                ledger_,
                node_.number("relative tolerance"),
                node_.number("absolute tolerance"),
                static_cast<unsigned int>(node_.integer("maximum iterations")),
                static_cast<unsigned int>(node_.integer("line search cuts"))};
    const auto      group = Teuchos::rcp(new NoxGroup(solve, x));
    NonlinearReport report;
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

    if (!report.converged)
      report.reason = solve.reason.empty() ? "Newton's method failed" : solve.reason;
    report.inadmissible         = solve.inadmissible;
    report.iterations           = solve.iterations;
    report.linear_iterations    = solve.linear_iterations;
    report.residual_evaluations = solve.function.evaluations();
    report.initial_residual     = solve.initial_norm;
    report.final_residual       = group->getNormF();
    return report;
  }

  NonlinearSolver::NonlinearSolver(const scene::Node &nonlinear, LinearSolver &linear, WorkLedger &ledger)
    : implementation_(std::make_unique<Implementation>(nonlinear, linear, ledger))
  {}

  NonlinearSolver::~NonlinearSolver() = default;

  NonlinearReport NonlinearSolver::solve(NonlinearProblem &problem, Vector &x) { return implementation_->solve(problem, x); }

  void NonlinearSolver::forget() { implementation_->forget(); }
} // namespace myolines
