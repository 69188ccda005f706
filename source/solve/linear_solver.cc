// SPDX-License-Identifier: LGPL-2.1-or-later
#include "direct_takeover.h"
#include "krylov_system.h"
#include "krylov_vectors.h"

#include <myolines/solve/linear_solver.h>
#include <myolines/solve/preconditioner.h>

#include <BelosBlockGmresSolMgr.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosPseudoBlockCGSolMgr.hpp>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

namespace myolines
{
  namespace
  {
    using Problem = Belos::LinearProblem<double, Belos::MultiVec<double>, Belos::Operator<double>>;
    using Manager = Belos::SolverManager<double, Belos::MultiVec<double>, Belos::Operator<double>>;
    using Entries = KrylovSystem::Entries;
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
      , tangent_(TangentOperator::form(linear.text("operator")), ledger)
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
                       const Vector &b, Vector &x, double tolerance, double enough, const LocalPart *local);

  private:
    void         go_on_or_throw() const;
    void         build(Linearisation &linearisation, const LocalEquations *kept);
    void         watch(unsigned int iterations, double tolerance);
    void         precondition(const KrylovSystem &system, const double *r, double *z) const;
    LinearReport attempt(bool symmetric, const KrylovSystem &system, const Entries &b, Entries &x, const LocalPart *local, double tolerance,
                         double enough);
    void         krylov(bool cg, const KrylovSystem &system, const Entries &b, Entries &x, double tolerance, LinearReport &report);
    bool         promising(double before, const LinearReport &report, double tolerance, double enough) const;
    double       true_residual(const KrylovSystem &system, const Entries &b, const Entries &x, const LocalPart *local) const;

    const std::string  type_;
    const unsigned int maximum_iterations_;
    const unsigned int restart_;
    const std::string  rebuild_;
    const double       slow_iterations_; ///< 0: set_up_cost()
    const bool         automatic_;
    const scene::Node  node_;
    WorkLedger        &ledger_;
    const StopRequest  stop_;

    TangentOperator                              tangent_;
    std::unique_ptr<Preconditioner>              preconditioner_;
    DirectTakeover                               takeover_;
    bool                                         kept_   = false; ///< it is for the system with local unknowns,
    double                                       weight_ = 0;     ///< of u
    std::unique_ptr<LocalEquations::Elimination> elimination_;    ///< and these belong to it
    bool                                         outdated_ = true;
    bool                                         fresh_    = false;
    double                                       fastest_  = 0; ///< fewest iterations per decade of a solve since the last set-up
    double                                       excess_   = 0; ///< iterations beyond that, summed over the solves since then
  };

  void LinearSolver::Implementation::go_on_or_throw() const
  {
    if (asked_to_stop())
      throw std::runtime_error("the run is asked to stop");
  }

  void LinearSolver::Implementation::build(Linearisation &linearisation, const LocalEquations *kept)
  {
    go_on_or_throw();
    const WorkLedger::Timer timer(ledger_, "preconditioner");
    ledger_.count("preconditioner set-ups");
    if (!preconditioner_)
      {
        const std::size_t n = tangent_.layout().size();
        preconditioner_     = make_preconditioner(node_, {n, linearisation.has_two_levels(), ledger_});
        takeover_           = {node_, linearisation, n, dealii::Utilities::MPI::n_mpi_processes(tangent_.layout().get_mpi_communicator())};
      }
    outdated_ = true; // until the set-up has succeeded
    preconditioner_->build(tangent_);
    elimination_ = kept != nullptr ? kept->eliminate(!preconditioner_->exact()) : nullptr;
    kept_        = kept != nullptr;
    outdated_    = false;
    fresh_       = true;
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

  /// |b - J x| / |b|; where local unknowns are kept but not asked for (@p local null), of the equation with them eliminated.
  double LinearSolver::Implementation::true_residual(const KrylovSystem &system, const Entries &b, const Entries &x,
                                                     const LocalPart *local) const
  {
    const double size = system.norm(b);
    if (elimination_ && local == nullptr)
      {
        Vector all(tangent_.layout()), r(tangent_.layout());
        system.take(x, all, nullptr);
        tangent_.apply(all, r);
        for (unsigned int i = 0; i < r.locally_owned_size(); ++i)
          r.local_element(i) -= b[i];
        return r.l2_norm() / size;
      }
    Entries r(b.size());
    system.apply(x.data(), r.data());
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] -= b[i];
    return system.norm(r) / size;
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
  void LinearSolver::Implementation::krylov(const bool cg, const KrylovSystem &system, const Entries &b, Entries &x, const double tolerance,
                                            LinearReport &report)
  {
    // Flexible gmres applies the tangent to what it keeps of the results: that these are rounded leaves its residual true. That of a basis
    // which is rounded is true to some 1e-7 of where the cycle began (Aliaga, Anzt and others, doi:10.1177/10943420221115140).
    const KrylovOperator::Rounds rounds{!cg && tolerance >= 1e-5, !cg};
    const KrylovOperator         tangent([&](const double *in, double *out) { system.apply(in, out); });
    const KrylovOperator         inverse([&](const double *in, double *out) { precondition(system, in, out); }, rounds);
    KrylovVectors                left(x.data(), x.size(), system.communicator());
    const KrylovVectors          right(const_cast<double *>(b.data()), b.size(), system.communicator());

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

  void LinearSolver::Implementation::precondition(const KrylovSystem &system, const double *r, double *z) const
  {
    go_on_or_throw();
    const WorkLedger::Timer timer(ledger_, "preconditioner application");
    ledger_.count("preconditioner applications");
    system.precondition(*preconditioner_, elimination_.get(), weight_, r, z);
  }

  LinearReport LinearSolver::Implementation::attempt(const bool symmetric, const KrylovSystem &system, const Entries &b, Entries &x,
                                                     const LocalPart *local, const double tolerance, const double enough)
  {
    LinearReport report;
    // Belos' own tests differ by round-off: let them stop a little later. With kept factors half a decade is cheaper than Newton.
    double     inner    = (preconditioner_->exact() ? 0.3 : 0.9) * tolerance;
    const auto verified = [&] {
      report.relative_residual = true_residual(system, b, x, local);
      if (report.relative_residual > tolerance)
        inner *= std::min(1., std::max(0.1, 0.5 * tolerance / report.relative_residual)); // for what Belos takes for solved
      return report.converged = report.relative_residual <= tolerance;
    };

    std::fill(x.begin(), x.end(), 0);
    if (preconditioner_->exact() && fresh_) // one application should do
      {
        precondition(system, b.data(), x.data());
        report.iterations = 1;
        if (verified())
          return report;
        if (!(report.relative_residual < 1))
          std::fill(x.begin(), x.end(), 0);
      }

    for (const bool cg : {true, false})
      {
        if (cg && !(type_ == "cg" || (type_ == "automatic" && symmetric && !elimination_)))
          continue;
        // It goes on while the iterations that are left would do at the rate of the last cycle: an indefinite operator, on which a
        // cycle gains next to nothing, is soon given up.
        for (double before = 1; !report.converged;)
          {
            try
              {
                krylov(cg, system, b, x, inner, report);
                report.reason = std::string(cg ? "cg" : "gmres") + " has not converged: stopped after " +
                                std::to_string(report.iterations) + " of at most " + std::to_string(maximum_iterations_) + " iterations";
              }
            catch (const std::bad_alloc &) // no step is to blame
              {
                throw;
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
            std::fill(x.begin(), x.end(), 0);
            report.relative_residual = 1;
          }
        if (cg)
          ledger_.count("krylov fallbacks");
      }
    return report;
  }

  LinearReport LinearSolver::Implementation::solve(Linearisation &linearisation, const WeightsByOrder &weights,
                                                   const Constraints &constraints, const bool symmetric, const Vector &b, Vector &x,
                                                   double tolerance, double enough, const LocalPart *local)
  {
    ledger_.count("linear solves");
    LinearReport report;
    Vector       right = b;
    if (!tangent_.is_of(linearisation) || tangent_.layout().size() != b.size())
      forget();
    tangent_.bind(linearisation, weights, constraints, b);
    weight_ = weights[2].u;
    x       = 0;
    if (local != nullptr)
      local->x = 0;

    const LocalEquations *kept = type_ == "cg" ? nullptr : tangent_.local();
    tangent_.keep_local(kept != nullptr);
    std::unique_ptr<LocalEquations::Elimination> exact;
    if (local != nullptr && kept == nullptr)
      {
        exact = linearisation.local()->eliminate(false);
        exact->condense(local->b, right);
        tangent_.free_unknowns().condense(right);
      }
    tangent_.free_unknowns().clear_constrained(right);
    const Vector       scale = kept != nullptr ? kept->local_scale(local == nullptr || local->strict) : Vector();
    const KrylovSystem system(tangent_, kept != nullptr ? &scale : nullptr, local != nullptr);
    const Entries      all  = system.right(right, kept != nullptr && local != nullptr ? &local->b : nullptr);
    const double       size = system.norm(all);
    Entries            solution(all.size());
    if (size == 0)
      {
        report.converged = true;
        return report;
      }
    if (local != nullptr)
      {
        constexpr double tightest = 1e-10; // what is beyond is rounding
        tolerance                 = std::min(0.9, std::max(tightest, tolerance * local->size / size));
        enough *= local->size / size;
      }
    unsigned int iterations = 0;
    try
      {
        fresh_ = false;
        if (!preconditioner_ || outdated_ || kept_ != (kept != nullptr))
          build(linearisation, kept);
        for (;;)
          {
            const bool fresh = fresh_;
            {
              const WorkLedger::Timer timer(ledger_, "linear solve");
              report = attempt(symmetric, system, all, solution, local, tolerance, enough);
            }
            iterations += report.iterations;
            watch(report.iterations, tolerance);
            const bool change = takeover_.due(report);
            if (change)
              {
                preconditioner_ = make_direct();
                outdated_       = true;
                ledger_.count("changes to direct solves");
              }
            if (report.converged || (fresh && !change))
              break;
            build(linearisation, kept);
          }
      }
    catch (const std::bad_alloc &)
      {
        throw;
      }
    catch (const std::exception &error)
      {
        report.converged         = false;
        report.reason            = error.what();
        report.relative_residual = 1;
        std::fill(solution.begin(), solution.end(), 0);
        outdated_ = true;
      }
    system.take(solution, x, kept != nullptr && local != nullptr ? &local->x : nullptr);
    if (exact)
      {
        right = x;
        tangent_.free_unknowns().distribute(right);
        exact->recover(weight_, right, local->b, local->x);
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
                                   const bool symmetric, const Vector &b, Vector &x, const double tolerance, const double enough,
                                   const LocalPart *local)
  {
    return implementation_->solve(linearisation, weights, constraints, symmetric, b, x, tolerance, enough, local);
  }
} // namespace myolines
