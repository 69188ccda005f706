#pragma once

#include <myolines/time/integrator.h>

namespace myolines
{
  /// One implicit stage: find d with
  ///
  ///     s R(t, u, v, a) + r* = 0,   (u, v, a) = (u~, v~, a~) + (c_u, c_v, c_a) d,   c_u != 0.
  ///
  /// Constrained unknowns end at u_c = g(t). With exact boundary rates the predictors v~, a~
  /// of constrained unknowns are shifted so that v_c = dg/dt, a_c = d2g/dt2 hold at the end; the map stays affine with
  /// the same weights, so Newton's lift needs no special case. With scheme rates v_c, a_c follow the method's formulas.
  struct Stage
  {
    double        t    = 0; ///< instant of the stage [s]
    Side          side = Side::left;
    Weights       c;                 ///< c_u, c_v, c_a
    double        scale   = 1;       ///< s
    const Vector *history = nullptr; ///< r*, or none
  };

  /// Solves stages for all one-step methods; owns the linearisation and the work vectors.
  class StageSolver
  {
  public:
    explicit StageSolver(const IntegratorContext &context);
    ~StageSolver();

    /// On entry @p point holds the predictors (u~, v~, a~) with t ignored, and @p d the initial guess (usually 0).
    /// On success @p point is the stage value at stage.t and d the solution; on failure both are unspecified.
    NonlinearReport solve(const Stage &stage, State &point, Vector &d);

    /// A step that is one stage, solved from d = 0: @p state becomes its value if it is accepted, else stays as it is.
    StepReport step(const Stage &stage, State predictors, State &state);

  private:
    class Problem;
    std::unique_ptr<Problem> problem_;
    NonlinearSolver         &solver_;
  };

  /// State at the beginning of a run, as the system gives it. With scheme rates prescribed unknowns start from v = a = 0, so that
  /// a motion that starts with a velocity gives the body an impulse in the first step, as in the thesis (errata 21).
  State starting_state(const SemiDiscreteSystem &system, double t0, BoundaryRates rates);

  /// Beginning of a smooth piece: with exact boundary rates the prescribed unknowns of @p state take their right limits.
  void start_piece(const IntegratorContext &context, State &state);

  /// Copies the verdict and the counts of a nonlinear solve into a step report, adding to counts already there.
  void record(const NonlinearReport &solve, StepReport &step);
} // namespace myolines
