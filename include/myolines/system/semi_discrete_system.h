// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/energetics.h>
#include <myolines/system/linearisation.h>
#include <myolines/system/point.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace myolines
{
  /// A named additive split R = R_I + F_E of a system: R_I, which holds M a, is solved for; F_E(t, u, v) is evaluated at known states.
  struct Split
  {
    std::string name;    ///< as in a scene: "linear"
    std::string summary; ///< what is implicit, one sentence
    std::string refused; ///< why it is known not to converge for this system; empty: nothing is known
  };

  /// What a system is, for integrators to decide whether they fit and for `check` to print.
  struct Capabilities
  {
    bool                      inertia           = true;  ///< dR/da != 0
    bool                      rates             = true;  ///< R depends on v
    bool                      linear            = false; ///< K, C, M do not depend on u, v
    bool                      constant_mass     = true;  ///< M does not depend on t, u, v
    bool                      symmetric_tangent = false; ///< K and C as linearised are symmetric
    bool                      energy            = false; ///< the system states its energy, see energetics()
    bool                      two_states        = false; ///< residuals of a step, see Point::before
    std::vector<unsigned int> orders            = {2};   ///< differential orders of the unknowns that occur
    std::vector<Split>        splits            = {};    ///< see implicit_part()
  };

  /// A semi-discrete system (method of lines), the interface between time integrators and physics:
  ///
  ///     R(t, u, v, a) = M a + F_int(t, u, v) - F_ext(t, u) = 0,      u = C q + g(t).
  ///
  /// Equal arguments give equal results, in any order of calls: no hidden time, no time step, no "previous" state.
  /// Residuals are full length: the row of a constrained unknown is its reaction, the force the constraint exerts.
  class SemiDiscreteSystem
  {
  public:
    virtual ~SemiDiscreteSystem() = default;

    virtual Capabilities capabilities() const = 0; ///< What the system is; the same at all times.

    /// Number of unknowns on all ranks, constrained ones included.
    virtual std::size_t n_unknowns() const = 0;

    /// State at time @p t0 [s] as the scene gives it; prescribed unknowns hold their right limits.
    virtual State initial_state(double t0) const = 0;

    /// The homogeneous relations u = C q: constrained unknowns and what they depend on. Constant in time.
    virtual const Constraints &constraints() const = 0;

    /// Sets u, v and a of the constrained unknowns of @p state to g, dg/dt, d2g/dt2 plus C applied to its free ones,
    /// with one-sided limits at kinks. Free entries are untouched; ghosts are current on return.
    virtual void prescribed(double t, Side side, State &state) const = 0;

    /// r = R(point); @p r has the layout of the state. If the state is inadmissible r is filled with NaN.
    ///
    /// With two states u0 (Point::before) and u1 (Point::u) the force is an algorithmic one, whose part of what the system stores in W is a
    /// discrete gradient (Gonzalez, doi:10.1007/BF02440162): F (u1 - u0) = W(u1) - W(u0), with the moments of a force, and the gradient
    /// at (u0 + u1)/2 but for terms of second order in u1 - u0. What has no energy is taken in the middle, at the rates Point::v.
    /// linearise() gives its derivatives by u1, v and a.
    ///
    /// With a dissipation chi (Point::dissipation) forces f of what stores energy have chi/2 (f(u1) - f(u0)) added, in a form that keeps
    /// the moments and whose work is not negative: F (u1 - u0) >= W(u1) - W(u0).
    virtual Evaluation residual(const Point &point, Vector &r) const = 0;

    /// A system may eliminate unknowns z of single cells, with R(u) = R(u, z(u)). Newton's method converges better if z are iterates
    /// beside u: it then asks for R(u, z) (Point::local) and for K at (u, z) with the linearised equation of z (Linearisation::local()).
    /// At z = z(u) R and K are the plain ones.

    /// z(u) at a displacement that is admissible; empty if the system eliminates nothing. No communication.
    virtual LocalUnknowns local(const Vector & /*u*/) const { return {}; }

    /// The iterate @p z moves by the part @p alpha of a Newton step, @p step in it (a vector of LocalEquations), to @p trial_z, where u has
    /// become that of @p trial. What becomes inadmissible makes the residual there inadmissible. Vectors need current ghosts.
    virtual void advance(const LocalUnknowns & /*z*/, const Vector & /*step*/, const Point & /*trial*/, double /*alpha*/,
                         LocalUnknowns & /*trial_z*/) const
    {}

    /// Storage for linearisations, once.
    virtual std::unique_ptr<Linearisation> make_linearisation() const = 0;

    /// Refills @p linearisation (from make_linearisation() of this system) at an admissible @p point.
    virtual void linearise(const Point &point, Linearisation &linearisation) const = 0;

    /// Energy and its rates at an admissible @p state; @p side as of a Point. Of systems with Capabilities::energy only. Collective.
    virtual Energetics energetics(const State & /*state*/, Side /*side*/) const
    {
      throw std::logic_error("the system does not state its energy");
    }

    /// R_I of a split of capabilities(): a system with the same unknowns, constraints, prescribed motion, mass and events.
    /// F_E = R - R_I. This system outlives it. nullptr for other names.
    virtual std::unique_ptr<SemiDiscreteSystem> implicit_part(const std::string & /*split*/) const { return nullptr; }

    /// How forces that push and turn the system as a whole change a velocity @p w: the fields e, and e x w, for every direction e along or
    /// about which the system may move as a whole. Constraints play no part. Empty: it cannot.
    virtual std::vector<Vector> rigid_motions(const Vector & /*w*/) const { return {}; }

    /// Kinks of the drives in the open interval (t0, t1), ascending.
    virtual std::vector<double> events(double t0, double t1) const = 0;

    /// Local numbers of the owned entries of this rank in an order for files: those of the first rank, then of the second, ...
    /// are one sequence of unknowns that does not depend on how many ranks share them. Every owned entry occurs once.
    /// By default the order of the numbering, for systems whose numbering does not depend on the ranks.
    virtual std::vector<unsigned int> canonical_order() const;
  };
} // namespace myolines
