// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/linearisation.h>

#include <limits>
#include <optional>

namespace myolines
{
  /// F(x) = 0 on free unknowns, x_c = target_c (+ C x_free) on constrained ones, as Newton's method sees it.
  /// x is full length. x may start with constrained entries that differ from the target: the solver lifts them in its
  /// first step (J_ff dx_f = -F_f - J_fc dx_c) and re-applies what remains if that step was damped.
  class NonlinearProblem
  {
  public:
    virtual ~NonlinearProblem() = default;

    virtual const Constraints &constraints() const = 0; ///< u = C q, see SemiDiscreteSystem::constraints()

    /// Sets the constrained entries of @p x to their final values (for its free ones); ghosts are current on return.
    virtual void impose(Vector &x) const = 0;

    /// Full-length residual; rows of constrained unknowns are reactions and are ignored by the solver.
    virtual Evaluation residual(const Vector &x, Vector &f) = 0;

    /// Makes linearisation() that of @p x, a point where residual() was admissible.
    virtual void linearise(const Vector &x) = 0;

    virtual Linearisation        &linearisation()   = 0; ///< of the last linearise() or linearise_at()
    virtual const WeightsByOrder &weights() const   = 0; ///< J = dF/dx = weights applied to the linearisation
    virtual bool                  symmetric() const = 0; ///< whether J is symmetric

    /// Local unknowns z that are iterates beside x, at the start of a solve, whatever its first guess; empty: F has none. residual() is
    /// F(x, z(x)), the function whose root is sought.
    virtual LocalUnknowns start_local() const { return {}; }

    /// F(x, z), which Newton's method makes small on its way.
    virtual Evaluation residual_at(const Vector &x, const LocalUnknowns & /*z*/, Vector &f) { return residual(x, f); }

    /// Makes linearisation() that of x and z; it has LocalEquations then.
    virtual void linearise_at(const Vector &x, const LocalUnknowns & /*z*/) { linearise(x); }

    /// The residual of the equation of z at the last linearise_at(), times the factor of residuals of the system in F.
    virtual void local_residual(Vector & /*g*/) {}

    /// z moves by the part @p alpha of a Newton step, @p dz in it (as LocalEquations have it), x to @p trial.
    virtual void advance(const LocalUnknowns & /*z*/, const Vector & /*dz*/, const Vector & /*trial*/, double /*alpha*/,
                         LocalUnknowns & /*trial_z*/)
    {}

    /// Called at the first guess @p x: F may from now on be evaluated at better rates than those of x. False: it is not, on any rank.
    /// Newton's method closes that gap w as it closes the one of constrained entries; see LiftedFunction.
    virtual bool open_rates(const Vector & /*x*/) { return false; }

    /// From now on @p share of the rate gap is open; 0: F is evaluated at the rates of x.
    virtual void keep_open(double /*share*/) {}

    /// What is open now becomes the whole gap w, and @p y -= (dF/dw) w at the last linearise().
    virtual void lift_rates(Vector & /*y*/) {}

    /// How many Newton steps in a row the line search may wait until the residual is below that before them, where a shortened step counts
    /// as four; 0: every step has to lower it.
    virtual unsigned int patience() const { return 0; }

    /// Cuts of a step after which the solve is given up, at most: another first guess promises more.
    virtual unsigned int most_cuts() const { return std::numeric_limits<unsigned int>::max(); }

    /// Whether F is affine: a direct solve then ends at the root, where only rounding is left of the residual.
    virtual bool affine() const { return false; }

    /// Whether F is a residual of the system, in whose unit the absolute tolerance of a solver is given; else F is solved relatively.
    virtual bool has_unit_of_residual() const { return true; }

    /// Entries of x mean no more than this: what the rounding of the numbers that they are added to makes of them.
    virtual double resolution() const { return 0; }

    /// How much a change @p dx of x matters, 1 or less if it does not. A solve then also ends where what remains, estimated from
    /// the last Newton steps, does not matter. None: the residual alone decides.
    virtual std::optional<double> importance(const Vector & /*dx*/) const { return std::nullopt; }
  };
} // namespace myolines
