#include <myolines/solve/free_unknowns.h>
#include <myolines/solve/linear_solver.h>
#include <myolines/solve/preconditioner.h>

#include <BelosEpetraAdapter.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosPseudoBlockCGSolMgr.hpp>
#include <BelosPseudoBlockGmresSolMgr.hpp>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>

#include <stdexcept>

namespace myolines
{
  namespace
  {
    using Problem = Belos::LinearProblem<double, Epetra_MultiVector, Epetra_Operator>;
    using Manager = Belos::SolverManager<double, Epetra_MultiVector, Epetra_Operator>;

    /// A Preconditioner as Belos sees it: Apply() is the approximate inverse.
    class PreconditionerOperator : public Epetra_Operator
    {
    public:
      PreconditionerOperator(const Preconditioner &preconditioner, const Epetra_Operator &matrix)
        : preconditioner_(preconditioner)
        , matrix_(matrix)
      {}

      int Apply(const Epetra_MultiVector &x, Epetra_MultiVector &y) const override
      {
        for (int column = 0; column < x.NumVectors(); ++column)
          preconditioner_.apply(x[column], y[column]);
        return 0;
      }

      int                SetUseTranspose(bool) override { return -1; }
      int                ApplyInverse(const Epetra_MultiVector &, Epetra_MultiVector &) const override { return -1; }
      double             NormInf() const override { return 0; }
      const char        *Label() const override { return "preconditioner"; }
      bool               UseTranspose() const override { return false; }
      bool               HasNormInf() const override { return false; }
      const Epetra_Comm &Comm() const override { return matrix_.Comm(); }
      const Epetra_Map  &OperatorDomainMap() const override { return matrix_.OperatorRangeMap(); }
      const Epetra_Map  &OperatorRangeMap() const override { return matrix_.OperatorDomainMap(); }

    private:
      const Preconditioner  &preconditioner_;
      const Epetra_Operator &matrix_;
    };

    Epetra_Vector view(const Vector &x, const Epetra_Map &map) { return Epetra_Vector(View, map, const_cast<double *>(x.begin())); }

    const PreconditionerEntry &chosen(const scene::Node &node)
    {
      const std::string name = node.text("type");
      for (const PreconditionerEntry &entry : preconditioner_registry())
        if (entry.name == name)
          return entry;
      throw std::logic_error("preconditioner \"" + name + "\" is not registered");
    }
  } // namespace

  scene::Schema LinearSolver::linear_schema()
  {
    using scene::Range;
    scene::Schema schema("Krylov solver for the linear systems of Newton's method.");
    schema
        .choice("type", "automatic", {"automatic", "cg", "gmres"},
                "Method; automatic: cg if the operator is symmetric, else gmres. A cg that fails falls back to gmres.")
        .integer("maximum iterations", 1000, Range::closed(1, 100000), "Largest number of iterations of one solve.")
        .integer("restart", 100, Range::closed(1, 1000), "gmres starts anew after this many iterations; it stores as many vectors.");
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
        .choice("rebuild", "when slow", {"every step", "when slow"},
                "When to set it up anew: for every nonlinear solve, or when iterations have grown.")
        .integer("slow iterations", 10, Range::closed(1, 1000),
                 "Iterations beyond those of the first solve after a set-up that call for a new one.");
    return schema;
  }

  class LinearSolver::Implementation
  {
  public:
    Implementation(const scene::Node &linear, const scene::Node &preconditioner, WorkLedger &ledger)
      : type_(linear.text("type"))
      , maximum_iterations_(linear.integer("maximum iterations"))
      , restart_(linear.integer("restart"))
      , every_step_(preconditioner.text("rebuild") == "every step")
      , slow_iterations_(preconditioner.integer("slow iterations"))
      , automatic_(preconditioner.text("type") == "automatic")
      , node_(preconditioner)
      , ledger_(ledger)
    {}

    bool automatic() const { return automatic_; }
    void new_step() { outdated_ = outdated_ || every_step_; }
    void forget() { preconditioner_.reset(); }

    LinearReport solve(Linearisation &linearisation, const WeightsByOrder &weights, const Constraints &constraints, const bool symmetric,
                       const Vector &b, Vector &x, const double tolerance);

  private:
    const SparseMatrix &assemble(Linearisation &linearisation, const WeightsByOrder &weights);
    void                build(const SparseMatrix &matrix, const MultilevelData *multilevel, std::size_t n_unknowns);
    LinearReport        attempt(const SparseMatrix &matrix, bool symmetric, const Vector &b, Vector &x, double tolerance);
    void                krylov(bool cg, const SparseMatrix &matrix, const Vector &b, Vector &x, double tolerance, LinearReport &report);
    double              true_residual(const SparseMatrix &matrix, const Vector &b, const Vector &x) const;

    const std::string  type_;
    const unsigned int maximum_iterations_;
    const unsigned int restart_;
    const bool         every_step_;
    const unsigned int slow_iterations_;
    const bool         automatic_;
    const scene::Node  node_;
    WorkLedger        &ledger_;

    std::unique_ptr<Preconditioner> preconditioner_;
    const SparseMatrix             *built_for_              = nullptr;
    std::size_t                     built_size_             = 0;
    bool                            outdated_               = true;
    bool                            fresh_                  = false;
    unsigned int                    iterations_after_build_ = 0;
  };

  const SparseMatrix &LinearSolver::Implementation::assemble(Linearisation &linearisation, const WeightsByOrder &weights)
  {
    const WorkLedger::Timer timer(ledger_, "assembly");
    return linearisation.sparse(weights);
  }

  void LinearSolver::Implementation::build(const SparseMatrix &matrix, const MultilevelData *multilevel, const std::size_t n_unknowns)
  {
    const WorkLedger::Timer timer(ledger_, "preconditioner");
    ledger_.count("preconditioner set-ups");
    if (!preconditioner_ || built_for_ != &matrix || built_size_ != n_unknowns)
      preconditioner_ = chosen(node_).make(node_, n_unknowns);
    built_for_  = &matrix;
    built_size_ = n_unknowns;
    outdated_   = true; // until the set-up has succeeded
    preconditioner_->build(matrix, multilevel);
    outdated_ = false;
    fresh_    = true;
  }

  double LinearSolver::Implementation::true_residual(const SparseMatrix &matrix, const Vector &b, const Vector &x) const
  {
    const Epetra_Map &map = matrix.trilinos_matrix().OperatorRangeMap();
    Epetra_Vector     r(map, false);
    matrix.trilinos_matrix().Apply(view(x, map), r);
    r.Update(1., view(b, map), -1.);
    double norm = 0;
    r.Norm2(&norm);
    return norm / b.l2_norm();
  }

  /// Improves @p x; throws what Belos throws on breakdown.
  void LinearSolver::Implementation::krylov(const bool cg, const SparseMatrix &matrix, const Vector &b, Vector &x, const double tolerance,
                                            LinearReport &report)
  {
    const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
    const Epetra_Map       &map    = epetra.OperatorRangeMap();
    Epetra_Vector           left   = view(x, map);
    Epetra_Vector           right  = view(b, map);
    PreconditionerOperator  inverse(*preconditioner_, epetra);

    const auto problem =
        Teuchos::rcp(new Problem(Teuchos::rcp<const Epetra_Operator>(&epetra, false), Teuchos::rcp<Epetra_MultiVector>(&left, false),
                                 Teuchos::rcp<const Epetra_MultiVector>(&right, false)));
    const auto inverse_pointer = Teuchos::rcp<const Epetra_Operator>(&inverse, false);
    if (cg)
      problem->setLeftPrec(inverse_pointer);
    else
      problem->setRightPrec(inverse_pointer);
    if (!problem->setProblem())
      throw std::runtime_error("Belos refuses the problem");

    const auto list = Teuchos::rcp(new Teuchos::ParameterList);
    list->set("Maximum Iterations", static_cast<int>(maximum_iterations_));
    list->set("Convergence Tolerance", tolerance);
    list->set("Implicit Residual Scaling", "Norm of RHS");
    list->set("Explicit Residual Scaling", "Norm of RHS");
    list->set("Verbosity", 0);
    if (!cg)
      {
        list->set("Num Blocks", static_cast<int>(restart_));
        list->set("Maximum Restarts", static_cast<int>(maximum_iterations_ / restart_ + 1));
        list->set("Orthogonalization", "ICGS");
      }
    else
      {
        list->remove("Implicit Residual Scaling");
        list->remove("Explicit Residual Scaling");
        list->set("Residual Scaling", "Norm of RHS");
      }

    std::unique_ptr<Manager> manager;
    if (cg)
      manager = std::make_unique<Belos::PseudoBlockCGSolMgr<double, Epetra_MultiVector, Epetra_Operator>>(problem, list);
    else
      manager = std::make_unique<Belos::PseudoBlockGmresSolMgr<double, Epetra_MultiVector, Epetra_Operator>>(problem, list);
    manager->solve();
    report.iterations += manager->getNumIters();
  }

  LinearReport LinearSolver::Implementation::attempt(const SparseMatrix &matrix, const bool symmetric, const Vector &b, Vector &x,
                                                     const double tolerance)
  {
    LinearReport report;
    // The inner tests of Belos differ from the true residual by round-off: let them stop a little later.
    const double inner    = 0.9 * tolerance;
    const auto   verified = [&] {
      report.relative_residual = true_residual(matrix, b, x);
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
        try
          {
            krylov(cg, matrix, b, x, inner, report);
            report.reason = std::string(cg ? "cg" : "gmres") + " has not converged: stopped after " + std::to_string(report.iterations) +
                            " of at most " + std::to_string(maximum_iterations_) + " iterations";
          }
        catch (const std::exception &error)
          {
            report.reason = std::string(cg ? "cg" : "gmres") + " broke down: " + error.what();
          }
        if (verified())
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
                                                   const double tolerance)
  {
    ledger_.count("linear solves");
    LinearReport report;
    Vector       right = b;
    FreeUnknowns(constraints, right).clear_constrained(right);
    x = 0;
    if (right.l2_norm() == 0)
      {
        report.converged = true;
        return report;
      }

    unsigned int iterations = 0;
    try
      {
        const SparseMatrix &matrix = assemble(linearisation, weights);
        fresh_                     = false;
        if (!preconditioner_ || outdated_ || built_for_ != &matrix || built_size_ != b.size())
          build(matrix, linearisation.multilevel(), b.size());
        for (;;)
          {
            const bool fresh = fresh_;
            {
              const WorkLedger::Timer timer(ledger_, "linear solve");
              report = attempt(matrix, symmetric, right, x, tolerance);
            }
            iterations += report.iterations;
            if (fresh)
              iterations_after_build_ = report.iterations;
            if (report.converged || fresh)
              break;
            build(matrix, linearisation.multilevel(), b.size());
          }
        outdated_ = report.iterations > iterations_after_build_ + slow_iterations_;
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

  LinearSolver::LinearSolver(const scene::Node &linear, const scene::Node &preconditioner, WorkLedger &ledger)
    : implementation_(std::make_unique<Implementation>(linear, preconditioner, ledger))
  {}

  LinearSolver::~LinearSolver() = default;

  bool LinearSolver::automatic() const { return implementation_->automatic(); }

  void LinearSolver::new_step() { implementation_->new_step(); }

  void LinearSolver::forget() { implementation_->forget(); }

  LinearReport LinearSolver::solve(Linearisation &linearisation, const WeightsByOrder &weights, const Constraints &constraints,
                                   const bool symmetric, const Vector &b, Vector &x, const double tolerance)
  {
    return implementation_->solve(linearisation, weights, constraints, symmetric, b, x, tolerance);
  }
} // namespace myolines
