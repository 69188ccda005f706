// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/integrator.h>

namespace myolines
{
  /// One implicit stage: find d so that the values at its end,
  ///
  ///     (u, v, a) = (u~, v~, a~) + (c_u, c_v, c_a) d,   c_u != 0 or c_a != 0,
  ///
  /// satisfy s R + r* = 0, with R at the end of the stage or at an average with earlier values.
  ///
  /// Constrained unknowns end at u = g(t). With exact boundary rates their predictors are shifted so that v = dg/dt and
  /// a = d2g/dt2 hold too; the map stays affine with the same weights, so Newton's lift needs no special case. With scheme
  /// rates v and a follow the formulas of the method. A stage with c_u = 0 says nothing of the acceleration that leads to
  /// g(t): its constrained unknowns take d2g/dt2 with either kind of rates, and v by the formula with scheme rates.
  struct Stage
  {
    /// end of the stage [s]
    double        t    = 0;          ///< end of the stage [s]
    Side          side = Side::left; ///< of a kink at t
    Weights       c;                 ///< c_u, c_v, c_a
    double        scale   = 1;       ///< s
    const Vector *history = nullptr; ///< r*, or none

    /// The residual is evaluated at offset + weight * (end of the stage), component by component, with loads of instant t.
    struct Average
    {
      double       t;      ///< instant of the loads [s]
      const State *offset; ///< of u, v and a
      Weights      weight; ///< of u, v and a
    };
    const Average *average = nullptr; ///< none: at the end of the stage

    const Vector *before      = nullptr; ///< Point::before, of systems that are not linear; or none
    double        dissipation = 0;       ///< Point::dissipation

    /// What velocities at the end have beyond the affine map.
    class Beyond
    {
    public:
      virtual ~Beyond() = default;
      /// @p b: of the displacements @p u at the end. Not of constrained unknowns.
      virtual void evaluate(const Vector &u, Vector &b) = 0;
    };
    /// v += b and a += b times this rate, v not where the residual is evaluated. Newton's method knows nothing of its derivatives. Or none.
    Beyond *beyond      = nullptr;
    double  beyond_rate = 0; ///< [1/s]

    /// First guess of the velocities, or none: those of the guess of d. Where the system has local unknowns (SemiDiscreteSystem::local())
    /// Newton's method starts at the d that belongs to them, and only if it fails at the guess of d. Elsewhere, and then, it starts at
    /// velocities that do not belong to its displacements; its first step closes the gap.
    const Vector *first_v = nullptr;

    /// False: constrained unknowns keep their predictors and g(t) plays no part.
    bool prescribed = true;
  };

  class StageWork;

  /// Solves stages for all methods; owns the linearisation and the work vectors.
  class StageSolver
  {
  public:
    explicit StageSolver(const IntegratorContext &context); ///< Of the system and with the solver of @p context.
    ~StageSolver();

    /// On entry @p point holds the predictors (u~, v~, a~) with t ignored, and @p d the initial guess (usually 0).
    /// On success @p point is the end of the stage and d the solution; on failure both are unspecified.
    NonlinearReport solve(const Stage &stage, State &point, Vector &d);

    /// The same from the guess that serves methods, made of @p last, a state that the body has had: the last step, or stage before.
    ///
    /// Methods write u = u~ + d with u~ extrapolated, so that accelerations are d over dt^2 without cancellation. The guess is d = 0
    /// for linear systems: a correction of the size of dt^2 a has errors 1/(omega dt) times smaller than one of the size of dt v.
    /// For others it is the displacement of @p last: extrapolated ones violate the volume constraint of nearly incompressible bodies and
    /// make the tangent indefinite. With that displacement u~ + d, velocities v~ + c_v d may be far from any the body has had:
    /// Stage::first_v is that of @p last. A stage with c_u = 0 is guessed with d = 0.
    NonlinearReport solve(const Stage &stage, State &point, const State &last);

    /// A step that is one stage, solved from that guess: @p state becomes its end if it is accepted, else stays as it is. @p predictors
    /// are unspecified afterwards.
    StepReport step(const Stage &stage, State &predictors, State &state);

    /// J d + r = 0 with J = w.u K + w.v C + w.a M of the last linearise(); linearly implicit methods need no more. On entry
    /// @p d holds values for the constrained unknowns (what they depend on is added) and 0 for the free ones. @p roughly: one linear
    /// solve to `forcing maximum`, for iterations that correct it. @p rounding: Evaluation::rounding of @p r, below which nothing is asked
    /// for.
    NonlinearReport solve_linear(const Weights &weights, const Vector &r, Vector &d, bool roughly = false, double rounding = 0);

    /// error <- (1 - g dy'/dy)^-1 error for y = (u, v), roughly solved, with the last linearisation and the weights (1, 1/g, 1/g^2) of
    /// the last stage (for weights at an average: their like). Components that the step cannot resolve, which say nothing of the
    /// motion, fall out; of others the leading term stays (Hosea and Shampine, doi:10.1016/0168-9274(95)00115-8; Hairer and
    /// Wanner, doi:10.1007/978-3-642-05221-7, IV.8). Constrained entries have no error. a and t of @p error play no part.
    NonlinearReport damp(State &error);

    /// y = (w.u K + w.v C + w.a M) x of the last linearise().
    void apply(const Weights &weights, const Vector &x, Vector &y) const;

    /// Linearises the system at @p point, where its residual is admissible; a linear one only the first time.
    void linearise(const Point &point);

    /// The same where nothing but the mass is asked for: only the first time if that is constant.
    void linearise_mass(const Point &point);

  private:
    class LinearProblem;
    std::unique_ptr<StageWork> work_;
    NonlinearSolver           &solver_;
    const bool                 linear_;
    Vector                     d_;
  };

  /// Copies the verdict and the counts of a nonlinear solve into a step report, adding to counts already there.
  void record(const NonlinearReport &solve, StepReport &step);

  /// What the solve of an error estimate has cost; its failure, but not its residuals, which are no residuals of the step.
  void record_estimate(const NonlinearReport &solve, StepReport &step);

  /// The verdict of one residual evaluated outside the nonlinear solver, and its count.
  void record(const Evaluation &evaluation, StepReport &step);
} // namespace myolines
