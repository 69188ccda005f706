// SPDX-License-Identifier: LGPL-2.1-or-later
#include "krylov_vectors.h"

#include <myolines/solve/linear_solver.h>
#include <myolines/solve/preconditioner.h>

#include <BelosBlockGmresSolMgr.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosPseudoBlockCGSolMgr.hpp>

#include <cmath>
#include <stdexcept>

namespace myolines
{
  namespace
  {
    using Problem = Belos::LinearProblem<double, Belos::MultiVec<double>, Belos::Operator<double>>;
    using Manager = Belos::SolverManager<double, Belos::MultiVec<double>, Belos::Operator<double>>;

    KrylovVectors view(const Vector &x) { return {const_cast<double *>(x.begin()), x.locally_owned_size(), x.get_mpi_communicator()}; }
  } // namespace

  scene::Schema LinearSolver::linear_schema()
  {
    using scene::Range;
    scene::Schema schema("Krylov solver for the linear systems of Newton's method.");
    schema
        .choice("type", "automatic", {"automatic", "cg", "gmres"},
                "Method; automatic: cg if the operator is symmetric, else gmres. A cg that fails falls back to gmres.")
        .choice("operator", "automatic", {"automatic", "matrix-free", "assembled"},
                "How the tangent is applied; automatic: matrix-free where the system has a fast action, else by its matrix.")
        .integer("maximum iterations", 1000, Range::closed(1, 100000), "Largest number of iterations of one solve.")
        .integer("restart", 60, Range::closed(1, 1000), "gmres starts anew after this many iterations; it stores twice as many vectors.");
    return schema;
  }

  scene::Schema LinearSolver::preconditioner_schema()
  {
    using scene::Range;
    std::vector<std::pair<std::string, scene::Schema>> alternatives;
    for (const PreconditionerEntry &entry : preconditioner_registry())
      alternatives.emplace_back(entry.name, entry.schema);
    scene::Schema schema("Preconditioner of the Krylov solver.");
    schema.variant("type", "automatic", alternatives, "Kind of preconditioner.")
        .choice("rebuild", "automatic", {"automatic", "every step", "when slow"},
                "When to set it up anew: for every nonlinear solve and when keeping it has cost as much as a set-up, or only then; "
                "automatic: for every solve if a set-up costs less than 20 iterations.")
        .optional_number("slow iterations", "-", Range::closed(1, 100000),
                         "Iterations that keeping it may cost, beyond those of a fresh one; not given: about what a set-up costs.");
    return schema;
  }

  namespace
  {
    TangentOperator::Form form(const scene::Node &linear)
    {
      const std::string name = linear.text("operator");
      return name == "automatic"   ? TangentOperator::Form::automatic
             : name == "assembled" ? TangentOperator::Form::assembled
                                   : TangentOperator::Form::matrix_free;
    }
  } // namespace

  class LinearSolver::Implementation
  {
  public:
    Implementation(const scene::Node &linear, const scene::Node &preconditioner, WorkLedger &ledger, StopRequest stop)
      : type_(linear.text("type"))
      , maximum_iterations_(linear.integer("maximum iterations"))
      , restart_(linear.integer("restart"))
      , rebuild_(preconditioner.text("rebuild"))
      , slow_iterations_(preconditioner.has("slow iterations") ? preconditioner.number("slow iterations") : 0)
      , automatic_(preconditioner.text("type") == "automatic")
      , node_(preconditioner)
      , ledger_(ledger)
      , stop_(std::move(stop))
      , tangent_(form(linear), ledger)
    {}

    bool automatic() const { return automatic_; }
    bool asked_to_stop() const { return stop_ && stop_(); }
    void new_step()
    {
      outdated_ = outdated_ || rebuild_ == "every step" ||
                  (rebuild_ == "automatic" && preconditioner_ != nullptr && preconditioner_->set_up_cost() < 20);
    }
    void forget() { preconditioner_.reset(); }

    LinearReport solve(Linearisation &linearisation, const WeightsByOrder &weights, const Constraints &constraints, const bool symmetric,
                       const Vector &b, Vector &x, const double tolerance, const double enough);

  private:
    void         go_on_or_throw() const;
    void         build(Linearisation &linearisation);
    void         watch(unsigned int iterations, double tolerance);
    LinearReport attempt(bool symmetric, const Vector &b, Vector &x, double tolerance, double enough);
    void         krylov(bool cg, const Vector &b, Vector &x, double tolerance, LinearReport &report);
    bool         promising(double before, const LinearReport &report, double tolerance, double enough) const;
    double       true_residual(const Vector &b, const Vector &x) const;

    const std::string  type_;
    const unsigned int maximum_iterations_;
    const unsigned int restart_;
    const std::string  rebuild_;
    const double       slow_iterations_; ///< 0: set_up_cost()
    const bool         automatic_;
    const scene::Node  node_;
    WorkLedger        &ledger_;
    const StopRequest  stop_;

    TangentOperator                 tangent_;
    std::unique_ptr<Preconditioner> preconditioner_;
    bool                            outdated_ = true;
    bool                            fresh_    = false;
    double                          fastest_  = 0; ///< fewest iterations per decade of a solve since the last set-up
    double                          excess_   = 0; ///< iterations beyond that, summed over the solves since then
  };

  void LinearSolver::Implementation::go_on_or_throw() const
  {
    if (asked_to_stop())
      throw std::runtime_error("the run is asked to stop");
  }

  void LinearSolver::Implementation::build(Linearisation &linearisation)
  {
    go_on_or_throw();
    const WorkLedger::Timer timer(ledger_, "preconditioner");
    ledger_.count("preconditioner set-ups");
    if (!preconditioner_)
      preconditioner_ = make_preconditioner(node_, {tangent_.layout().size(), linearisation.has_two_levels(), ledger_});
    outdated_ = true; // until the set-up has succeeded
    preconditioner_->build(tangent_);
    outdated_ = false;
    fresh_    = true;
  }

  /// Keeping a preconditioner pays until the iterations it has cost beyond those of its best solve are worth a set-up:
  /// never more than twice the work of the best policy, whatever the future brings.
  void LinearSolver::Implementation::watch(const unsigned int iterations, const double tolerance)
  {
    const double decades = std::max(1., -std::log10(tolerance)), rate = iterations / decades;
    if (fresh_)
      {
        fastest_ = rate;
        excess_  = 0;
      }
    fastest_ = std::min(fastest_, rate);
    excess_ += iterations - fastest_ * decades;
    outdated_ = outdated_ || excess_ > (slow_iterations_ > 0 ? slow_iterations_ : preconditioner_->set_up_cost());
  }

  double LinearSolver::Implementation::true_residual(const Vector &b, const Vector &x) const
  {
    Vector r(tangent_.layout());
    tangent_.apply(x, r);
    r.sadd(-1, b);
    return r.l2_norm() / b.l2_norm();
  }

  /// Whether what is left of the iterations would do if every cycle reduced the residual like the last one, from @p before. Where the
  /// residual is small @p enough anyway, a cycle must have halved it.
  bool LinearSolver::Implementation::promising(const double before, const LinearReport &report, const double tolerance,
                                               const double enough) const
  {
    const double now = report.relative_residual;
    if (report.iterations >= maximum_iterations_ || !(now < before) || (now <= enough && now > 0.5 * before))
      return false;
    return now * std::pow(now / before, static_cast<double>(maximum_iterations_ - report.iterations) / restart_) <= tolerance;
  }

  /// Improves @p x, with gmres by one cycle; throws what Belos throws on breakdown.
  void LinearSolver::Implementation::krylov(const bool cg, const Vector &b, Vector &x, const double tolerance, LinearReport &report)
  {
    KrylovVectors        left = view(x), right = view(b);
    Vector               from(tangent_.layout()), to(tangent_.layout());
    const KrylovOperator tangent([&](const double *in, double *out) {
      std::copy_n(in, from.locally_owned_size(), from.begin());
      tangent_.apply(from, to);
      std::copy_n(to.begin(), to.locally_owned_size(), out);
    });
    // Flexible gmres applies the tangent to what it keeps of the results: that these are rounded leaves its residual true. That of a basis
    // which is rounded is true to some 1e-7 of where the cycle began (Aliaga, Anzt and others, doi:10.1177/10943420221115140).
    const KrylovOperator::Rounds rounds{!cg && tolerance >= 1e-5, !cg};
    const KrylovOperator         inverse(
        [&](const double *in, double *out) {
          go_on_or_throw();
          const WorkLedger::Timer timer(ledger_, "preconditioner application");
          ledger_.count("preconditioner applications");
          preconditioner_->apply(in, out);
        },
        rounds);

    const auto problem         = Teuchos::rcp(new Problem(Teuchos::rcp<const Belos::Operator<double>>(&tangent, false),
                                                          Teuchos::rcp<Belos::MultiVec<double>>(&left, false),
                                                          Teuchos::rcp<const Belos::MultiVec<double>>(&right, false)));
    const auto inverse_pointer = Teuchos::rcp<const Belos::Operator<double>>(&inverse, false);
    if (cg)
      problem->setLeftPrec(inverse_pointer);
    else
      problem->setRightPrec(inverse_pointer);
    if (!problem->setProblem())
      throw std::runtime_error("Belos refuses the problem");

    const auto         list      = Teuchos::rcp(new Teuchos::ParameterList);
    const unsigned int remaining = report.iterations < maximum_iterations_ ? maximum_iterations_ - report.iterations : restart_;
    list->set("Maximum Iterations", static_cast<int>(cg ? remaining : std::min(restart_, remaining)));
    list->set("Convergence Tolerance", tolerance);
    list->set("Implicit Residual Scaling", "Norm of RHS");
    list->set("Explicit Residual Scaling", "Norm of RHS");
    list->set("Verbosity", 0);
    if (!cg)
      {
        list->set("Num Blocks", static_cast<int>(restart_));
        list->set("Maximum Restarts", 0);
        list->set("Orthogonalization", "IMGS");
        // A preconditioner in single precision is no linear map: flexible gmres keeps its every result, and its residual is true.
        list->set("Flexible Gmres", true);
      }
    else
      {
        list->remove("Implicit Residual Scaling");
        list->remove("Explicit Residual Scaling");
        list->set("Residual Scaling", "Norm of RHS");
      }

    std::unique_ptr<Manager> manager;
    if (cg)
      manager = std::make_unique<Belos::PseudoBlockCGSolMgr<double, Belos::MultiVec<double>, Belos::Operator<double>>>(problem, list);
    else
      manager = std::make_unique<Belos::BlockGmresSolMgr<double, Belos::MultiVec<double>, Belos::Operator<double>>>(problem, list);
    manager->solve();
    report.iterations += manager->getNumIters();
  }

  LinearReport LinearSolver::Implementation::attempt(const bool symmetric, const Vector &b, Vector &x, const double tolerance,
                                                     const double enough)
  {
    LinearReport report;
    // The inner tests of Belos differ from the true residual by round-off: let them stop a little later.
    const double inner    = 0.9 * tolerance;
    const auto   verified = [&] {
      report.relative_residual = true_residual(b, x);
      return report.converged  = report.relative_residual <= tolerance;
    };

    x = 0;
    if (preconditioner_->exact())
      {
        preconditioner_->apply(b.begin(), x.begin());
        report.iterations = 1;
        if (verified())
          return report;
        if (!(report.relative_residual < 1)) // a kept factorisation may have become useless
          x = 0;
      }

    for (const bool cg : {true, false})
      {
        if (cg && !(type_ == "cg" || (type_ == "automatic" && symmetric)))
          continue;
        // It goes on while the iterations that are left would do at the rate of the last cycle: an indefinite operator, on which a
        // cycle gains next to nothing, is soon given up.
        for (double before = 1; !report.converged;)
          {
            try
              {
                krylov(cg, b, x, inner, report);
                report.reason = std::string(cg ? "cg" : "gmres") + " has not converged: stopped after " +
                                std::to_string(report.iterations) + " of at most " + std::to_string(maximum_iterations_) + " iterations";
              }
            catch (const std::exception &error)
              {
                report.reason = std::string(cg ? "cg" : "gmres") + " broke down: " + error.what();
              }
            if (verified() || !promising(before, report, tolerance, enough))
              break;
            before = report.relative_residual;
          }
        if (report.converged)
          {
            report.reason.clear();
            return report;
          }
        if (!(report.relative_residual < 1))
          {
            x                        = 0;
            report.relative_residual = 1;
          }
        if (cg)
          ledger_.count("krylov fallbacks");
      }
    return report;
  }

  LinearReport LinearSolver::Implementation::solve(Linearisation &linearisation, const WeightsByOrder &weights,
                                                   const Constraints &constraints, const bool symmetric, const Vector &b, Vector &x,
                                                   const double tolerance, const double enough)
  {
    ledger_.count("linear solves");
    LinearReport report;
    Vector       right = b;
    if (!tangent_.is_of(linearisation) || tangent_.layout().size() != b.size())
      forget();
    tangent_.bind(linearisation, weights, constraints, b);
    tangent_.free_unknowns().clear_constrained(right);
    x = 0;
    if (right.l2_norm() == 0)
      {
        report.converged = true;
        return report;
      }

    unsigned int iterations = 0;
    try
      {
        fresh_ = false;
        if (!preconditioner_ || outdated_)
          build(linearisation);
        for (;;)
          {
            const bool fresh = fresh_;
            {
              const WorkLedger::Timer timer(ledger_, "linear solve");
              report = attempt(symmetric, right, x, tolerance, enough);
            }
            iterations += report.iterations;
            if (report.converged || fresh)
              break;
            build(linearisation);
          }
        watch(report.iterations, tolerance);
      }
    catch (const std::exception &error)
      {
        report.converged         = false;
        report.reason            = error.what();
        report.relative_residual = 1;
        x                        = 0;
        outdated_                = true;
      }
    report.iterations = iterations;
    ledger_.count("linear iterations", iterations);
    return report;
  }

  LinearSolver::LinearSolver(const scene::Node &linear, const scene::Node &preconditioner, WorkLedger &ledger, StopRequest stop)
    : implementation_(std::make_unique<Implementation>(linear, preconditioner, ledger, std::move(stop)))
  {}

  LinearSolver::~LinearSolver() = default;

  bool LinearSolver::automatic() const { return implementation_->automatic(); }

  bool LinearSolver::asked_to_stop() const { return implementation_->asked_to_stop(); }

  void LinearSolver::new_step() { implementation_->new_step(); }

  void LinearSolver::forget() { implementation_->forget(); }

  LinearReport LinearSolver::solve(Linearisation &linearisation, const WeightsByOrder &weights, const Constraints &constraints,
                                   const bool symmetric, const Vector &b, Vector &x, const double tolerance, const double enough)
  {
    return implementation_->solve(linearisation, weights, constraints, symmetric, b, x, tolerance, enough);
  }
} // namespace myolines
