// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/solve/direction_solver.h>
#include <myolines/solve/free_unknowns.h>
#include <myolines/solve/nonlinear_problem.h>

#include <cstdint>
#include <optional>

namespace myolines
{
  /// A point of Newton's method and what was found there.
  struct Iterate
  {
    Vector        x; ///< the iterate
    LocalUnknowns z; ///< empty: the problem has none
    Vector        g; ///< G at x, z

    std::uint64_t stamp     = 0;     ///< names x and z: equal stamps, equal values
    double        remaining = 0;     ///< 1 - alpha, the part of the gap still open; 0: x_c = target
    Evaluation    evaluation;        ///< what the residual said of it
    bool          undefined = false; ///< inadmissible as loads or prescribed values are no numbers
    double        norm      = 0;     ///< of G and of the residual of z (Evaluation::local), over all ranks; NaN where inadmissible
  };

  /// Without copies; std::swap would make three, as vectors have no move assignment.
  inline void swap(Iterate &left, Iterate &right)
  {
    left.x.swap(right.x);
    left.z.values.swap(right.z.values);
    left.g.swap(right.g);
    std::swap(left.stamp, right.stamp);
    std::swap(left.remaining, right.remaining);
    std::swap(left.evaluation, right.evaluation);
    std::swap(left.undefined, right.undefined);
    std::swap(left.norm, right.norm);
  }

  /// A NonlinearProblem with its constraints built in, as one function whose root Newton's method seeks. From x_0, along
  /// alpha dx, it is
  ///
  ///     G = C^T (F(x_0 + alpha dx) + (1 - alpha) J(x_0) gap),   gap = target - x_0 on constrained unknowns, 0 on free ones,
  ///
  /// with dx = C dq + gap and C^T J C dq = -G(x_0): the Dirichlet lift. G falls like 1 - alpha whatever part of the gap is
  /// closed, so one line search serves steps with and without a lift; what a damped step leaves is lifted anew by the
  /// next. With nothing to lift G is the residual on the free unknowns.
  ///
  /// With local unknowns z, iterates beside x, F is F(x, z) and the lift is made with J at fixed z, so that neither knows how stiff the
  /// equation of z is; the direction solves for both (LocalEquations), and the part of the lift in the equation of z is in it.
  ///
  /// A gap w between the rates at which F is evaluated and those of x (NonlinearProblem::open_rates()) is closed with it: F is that of
  /// (1 - alpha) w, and (1 - alpha) (dF/dw) w is taken from G.
  class LiftedFunction
  {
  public:
    /// @p layout has the size and distribution of x. Serves any number of solves of problems with the same constraints.
    LiftedFunction(const Constraints &constraints, const Vector &layout, WorkLedger &ledger);

    /// Whether the constraints and the layout are those of the constructor.
    bool fits(const NonlinearProblem &problem, const Vector &x) const;

    /// A stamp never given before.
    std::uint64_t new_stamp() { return ++last_stamp_; }

    /// G at a first guess @p at .x with any constrained entries. What is missing of those by no more than the resolution of the problem
    /// is rounding, and mended. @p with_rates: rates that do not belong to x are asked for (NonlinearProblem::open_rates()).
    void first(NonlinearProblem &problem, bool with_rates, Iterate &at);

    /// @p to = @p from + alpha @p dx with its G; dx is the last direction(), found at @p from.
    void move(NonlinearProblem &problem, const Iterate &from, const Vector &dx, double alpha, Iterate &to);

    /// Newton direction at @p at, with |J dx + G| <= max(tolerance |G|, absolute) on the free unknowns. What a damped step left is
    /// lifted from here: G becomes that with remaining = 1.
    LinearReport direction(NonlinearProblem &problem, DirectionSolver &solver, Iterate &at, double tolerance, double absolute, Vector &dx);

    /// dx J dx on the free unknowns for a direction() from @p at.
    double curvature(NonlinearProblem &problem, const Iterate &at, const Vector &dx);

    /// |F(x, z(x))| on the free unknowns, where nothing remains of the gap; @p evaluation belongs to it.
    double true_norm(NonlinearProblem &problem, const Iterate &at, Evaluation &evaluation);

    unsigned int evaluations() const { return evaluations_; } ///< Residuals evaluated so far.

  private:
    void evaluate(NonlinearProblem &problem, Iterate &at);
    void set_gap(const NonlinearProblem &problem, const Vector &x);
    void linearise(NonlinearProblem &problem, const Iterate &at);
    void add_lift(NonlinearProblem &problem, Iterate &at);
    void set_norm(Iterate &at) const;

    const Constraints *constraints_;
    WorkLedger        &ledger_;
    const FreeUnknowns free_;
    Vector             gap_;
    Vector             lift_;      ///< C^T (J gap - (dF/dw) w) of the point lifted last, J at fixed z
    Vector             rate_lift_; ///< C^T (dF/dw) w of it
    Vector             right_, true_;
    Vector             dz_, right_z_, lift_z_; ///< of the local unknowns: the last direction, its right-hand side, w.u B gap
    bool               has_rate_gap_  = false;
    std::uint64_t      lifted_at_     = 0;
    std::uint64_t      linearised_at_ = 0;
    std::uint64_t      last_stamp_    = 0;
    unsigned int       evaluations_   = 0;
  };
} // namespace myolines
