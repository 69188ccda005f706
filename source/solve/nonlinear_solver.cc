// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nox_group.h"

#include <myolines/solve/band_directions.h>
#include <myolines/solve/nonlinear_solver.h>

#include <NOX_LineSearch_Generic.H>
#include <NOX_LineSearch_UserDefinedFactory.H>
#include <NOX_StatusTest_Generic.H>
#include <Teuchos_oblackholestream.hpp>

#include <new>

namespace myolines
{
  namespace
  {
    class Search : public NOX::LineSearch::Generic
    {
    public:
      explicit Search(Newton &newton)
        : newton_(newton)
      {}

      bool compute(NOX::Abstract::Group &group, double &step, const NOX::Abstract::Vector &direction,
                   const NOX::Solver::Generic &solver) override
      {
        auto       &to    = dynamic_cast<NoxGroup &>(group);
        const auto &from  = dynamic_cast<const NoxGroup &>(solver.getPreviousSolutionGroup());
        const auto  alpha = newton_.search(from.at, NoxVector::of(direction), to.at);
        to.moved();
        step = alpha.value_or(0);
        return alpha.has_value();
      }

    private:
      Newton &newton_;
    };

    class SearchFactory : public NOX::LineSearch::UserDefinedFactory
    {
    public:
      explicit SearchFactory(Newton &newton)
        : newton_(newton)
      {}
      Teuchos::RCP<NOX::LineSearch::Generic> buildLineSearch(const Teuchos::RCP<NOX::GlobalData> &, Teuchos::ParameterList &) const override
      {
        return Teuchos::rcp(new Search(newton_));
      }

    private:
      Newton &newton_;
    };

    class Test : public NOX::StatusTest::Generic
    {
    public:
      explicit Test(Newton &newton)
        : newton_(newton)
      {}

      NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic &solver, NOX::StatusTest::CheckType) override
      {
        const Newton::Verdict verdict = newton_.judge(dynamic_cast<const NoxGroup &>(solver.getSolutionGroup()).at);
        return status_                = verdict == Newton::Verdict::converged ? NOX::StatusTest::Converged
                                        : verdict == Newton::Verdict::failed  ? NOX::StatusTest::Failed
                                                                              : NOX::StatusTest::Unconverged;
      }

      NOX::StatusTest::StatusType getStatus() const override { return status_; }
      std::ostream               &print(std::ostream &stream, int) const override { return stream; }

    private:
      Newton                     &newton_;
      NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
    };
  } // namespace

  class KrylovDirections : public DirectionSolver
  {
  public:
    explicit KrylovDirections(LinearSolver &linear)
      : linear_(linear)
    {}

    bool exact() const override { return false; }

    LinearReport solve(NonlinearProblem &problem, const Vector &b, Vector &dx, const double tolerance, const double enough,
                       const LocalPart *local) override
    {
      return linear_.solve(problem.linearisation(), problem.weights(), problem.constraints(), problem.symmetric(), b, dx, tolerance, enough,
                           local);
    }

  private:
    LinearSolver &linear_;
  };

  scene::Schema NonlinearSolver::schema()
  {
    using scene::Range;
    const Range   fraction{0, 1, true, true};
    scene::Schema schema("Newton's method for the implicit stages.");
    schema
        .number("relative tolerance", 1e-8, "-", fraction,
                "Converged when the residual is below this part of the forces that it balances, of systems that do not tell those: of the "
                "residual at the first guess.")
        .optional_number("absolute tolerance", "unit of the residual", Range::not_negative(),
                         "Converged when the residual norm is below this; not given: 1e-10 for systems that do not tell the size of their "
                         "forces, no such limit for others.")
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
      : options_(node)
      , linear_(linear)
      , krylov_(linear)
      , bands_(ledger)
      , ledger_(ledger)
    {}

    NonlinearReport solve(NonlinearProblem &problem, Vector &x);
    void            forget() { linear_.forget(), bands_.forget(); }

  private:
    Teuchos::RCP<Teuchos::ParameterList> parameters(Newton &newton) const;
    void                                 iterate_directly(Newton &newton);
    void                                 iterate_with_nox(Newton &newton);

    const Newton::Options         options_;
    LinearSolver                 &linear_;
    KrylovDirections              krylov_;
    BandDirections                bands_;
    WorkLedger                   &ledger_;
    std::optional<LiftedFunction> function_;
    Iterate                       at_, trial_;
    Vector                        direction_;
  };

  Teuchos::RCP<Teuchos::ParameterList> NonlinearSolver::Implementation::parameters(Newton &newton) const
  {
    const auto list = Teuchos::rcp(new Teuchos::ParameterList);
    list->set("Nonlinear Solver", "Line Search Based");
    Teuchos::ParameterList &printing = list->sublist("Printing");
    printing.set("Output Information", 0);
    printing.set<Teuchos::RCP<std::ostream>>("Output Stream", Teuchos::rcp(new Teuchos::oblackholestream)); // some messages ask nobody
    printing.set<Teuchos::RCP<std::ostream>>("Error Stream", Teuchos::rcp(new Teuchos::oblackholestream));
    Teuchos::ParameterList &direction = list->sublist("Direction");
    direction.set("Method", "Newton");
    Teuchos::ParameterList &forcing = direction.sublist("Newton");
    forcing.set("Rescue Bad Newton Solve", false);
    forcing.set("Forcing Term Method", "Type 2");
    forcing.set("Forcing Term Initial Tolerance", options_.forcing_maximum);
    forcing.set("Forcing Term Minimum Tolerance", options_.forcing_minimum);
    forcing.set("Forcing Term Maximum Tolerance", options_.forcing_maximum);
    Teuchos::ParameterList &search = list->sublist("Line Search");
    search.set("Method", "User Defined");
    search.set<Teuchos::RCP<NOX::LineSearch::UserDefinedFactory>>("User Defined Line Search Factory",
                                                                  Teuchos::rcp(new SearchFactory(newton)));
    return list;
  }

  void NonlinearSolver::Implementation::iterate_with_nox(Newton &newton)
  {
    const auto group  = Teuchos::rcp(new NoxGroup(newton, at_));
    const auto solver = NOX::Solver::buildSolver(group, Teuchos::rcp(new Test(newton)), parameters(newton));
    try
      {
        solver->solve();
      }
    catch (const char *) // where the direction or the line search fails, Newton has the reason
      {}
    at_.x = dynamic_cast<const NoxGroup &>(solver->getSolutionGroup()).at.x;
  }

  /// A few unknowns are solved in the time that NOX takes to begin.
  void NonlinearSolver::Implementation::iterate_directly(Newton &newton)
  {
    while (newton.judge(at_) == Newton::Verdict::go_on)
      {
        if (!newton.direction(at_, 0, direction_) || !newton.search(at_, direction_, trial_))
          return;
        swap(at_, trial_);
      }
  }

  NonlinearReport NonlinearSolver::Implementation::solve(NonlinearProblem &problem, Vector &x)
  {
    const bool       direct = linear_.automatic() && BandDirections::fit(problem);
    DirectionSolver &solver = direct ? static_cast<DirectionSolver &>(bands_) : krylov_;
    if (!function_ || !function_->fits(problem, x))
      {
        function_.emplace(problem.constraints(), x, ledger_);
        bands_.forget();
        for (Vector *vector : {&at_.g, &trial_.x, &trial_.g, &direction_})
          *vector = x;
      }
    x.update_ghost_values();
    at_.x = x;
    linear_.new_step();
    Newton newton(options_, problem, *function_, solver, ledger_, [this] { return linear_.asked_to_stop(); });
    try
      {
        if (newton.begin(at_))
          direct ? iterate_directly(newton) : iterate_with_nox(newton);
      }
    catch (const std::bad_alloc &) // no step is to blame
      {
        throw;
      }
    catch (const std::exception &error)
      {
        newton.fail(error.what());
      }
    x = at_.x;
    x.update_ghost_values();
    return newton.report();
  }

  NonlinearSolver::NonlinearSolver(const scene::Node &nonlinear, LinearSolver &linear, WorkLedger &ledger)
    : implementation_(std::make_unique<Implementation>(nonlinear, linear, ledger))
  {}

  NonlinearSolver::~NonlinearSolver() = default;

  NonlinearReport NonlinearSolver::solve(NonlinearProblem &problem, Vector &x) { return implementation_->solve(problem, x); }

  void NonlinearSolver::forget() { implementation_->forget(); }
} // namespace myolines
