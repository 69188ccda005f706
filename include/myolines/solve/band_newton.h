#pragma once

#include <myolines/solve/free_unknowns.h>
#include <myolines/solve/nonlinear_solver.h>
#include <myolines/system/band_linearisation.h>

#include <optional>

namespace myolines
{
  /// Newton's method for problems whose linearisation is a BandLinearisation: the same lift, line search and convergence as
  /// in NonlinearSolver, with a direct solve per step and no set-up. A factorisation is kept while the matrix stays.
  ///
  /// Converged is also a point whose Newton step is below the resolution of the problem.
  class BandNewton
  {
  public:
    /// Parameters as NonlinearSolver::schema() declares them; those of inexact solves and patience play no part.
    BandNewton(const scene::Node &nonlinear, WorkLedger &ledger);

    /// As NonlinearSolver::solve, for the linearisation @p bands of @p problem.
    NonlinearReport solve(NonlinearProblem &problem, BandLinearisation &bands, Vector &x);

    void forget() { factored_.reset(); }

  private:
    /// What the matrix that is factored was made from.
    struct Factored
    {
      const BandLinearisation *bands;
      std::uint64_t            version;
      WeightsByOrder           weights;
    };

    void   allocate(const NonlinearProblem &problem, const Vector &x);
    bool   factorise(NonlinearProblem &problem, BandLinearisation &bands);
    double norm(const Vector &x) const;
    double evaluate(NonlinearProblem &problem, const Vector &x, double remaining, Evaluation &evaluation, NonlinearReport &report);
    void   set_gap(NonlinearProblem &problem, const Vector &x);
    void   add_lift(NonlinearProblem &problem, BandLinearisation &bands);
    std::optional<double> search(NonlinearProblem &problem, Vector &x, double &remaining, double tolerance, NonlinearReport &report);

    const double                relative_tolerance_, absolute_tolerance_;
    const unsigned int          maximum_iterations_, line_search_cuts_;
    WorkLedger                 &ledger_;
    const Constraints          *constraints_ = nullptr;
    std::optional<FreeUnknowns> free_;
    std::optional<BandMatrix>   matrix_;
    std::optional<Factored>     factored_;
    Vector                      g_, gap_, lift_, direction_, trial_;
    double                      norm_ = 0; ///< of g_
  };
} // namespace myolines
