#pragma once

#include <myolines/solve/free_unknowns.h>
#include <myolines/solve/linear_solver.h>
#include <myolines/solve/nonlinear_problem.h>
#include <myolines/system/ledger.h>

#include <cstdint>

namespace myolines
{
  /// A NonlinearProblem with its constraints built in, as one function whose root Newton's method seeks. From x_0, along
  /// alpha dx, it is
  ///
  ///     G = C^T (F(x_0 + alpha dx) + (1 - alpha) J(x_0) gap),   gap = target - x_0 on constrained unknowns, 0 on free ones,
  ///
  /// with dx = C dq + gap and C^T J C dq = -G(x_0): the Dirichlet lift. G falls like 1 - alpha whatever part of the gap is
  /// closed, so one line search serves steps with and without a lift; what a damped step leaves is lifted anew by the
  /// next. With nothing to lift G is the residual on the free unknowns.
  ///
  /// A gap w between the rates at which F is evaluated and those of x (NonlinearProblem::open_rates()) is closed with it: F is that of
  /// (1 - alpha) w, and (1 - alpha) (dF/dw) w is taken from G.
  class LiftedFunction
  {
  public:
    /// A point x and what was found there. stamp names the values of x: equal stamps, equal values.
    struct Sample
    {
      std::uint64_t stamp     = 0;
      double        remaining = 0; ///< 1 - alpha, the part of the gap still open; 0: x_c = target
      Evaluation    evaluation;
      double        norm = 0; ///< |G| over all ranks; NaN where inadmissible
    };

    LiftedFunction(NonlinearProblem &problem, LinearSolver &linear, WorkLedger &ledger, const Vector &layout);

    /// A stamp never given before.
    std::uint64_t new_stamp() { return ++last_stamp_; }

    /// g = G(x) at a first guess with any constrained entries.
    Sample first(const Vector &x, std::uint64_t stamp, Vector &g);

    /// g = G(x) at a trial point that leaves @p remaining of the gap of the last direction().
    Sample evaluate(const Vector &x, std::uint64_t stamp, double remaining, Vector &g);

    /// Newton direction at @p x, where @p sample and @p g were found, with |J dx + G| <= tolerance |G| on the free unknowns.
    /// What a damped step left is lifted from here: @p sample and @p g become those with remaining = 1.
    LinearReport direction(const Vector &x, Sample &sample, Vector &g, double tolerance, Vector &dx);

    /// Sets the constrained entries to their targets without round-off, where nothing remains.
    void impose(Vector &x) const { problem_.impose(x); }

    unsigned int evaluations() const { return evaluations_; }

  private:
    Sample sample_at(const Vector &x, std::uint64_t stamp, Vector &g);
    Vector gap(const Vector &x) const;
    void   linearise(const Vector &x, std::uint64_t stamp);
    void   add_lift(const Vector &x, const Vector &missing, Sample &sample, Vector &g);

    NonlinearProblem  &problem_;
    LinearSolver      &linear_;
    WorkLedger        &ledger_;
    const FreeUnknowns free_;
    Vector             lift_; ///< C^T (J gap - (dF/dw) w) of the point lifted last
    bool               has_rate_gap_  = false;
    std::uint64_t      lifted_at_     = 0;
    std::uint64_t      linearised_at_ = 0;
    std::uint64_t      last_stamp_    = 0;
    unsigned int       evaluations_   = 0;
  };
} // namespace myolines
