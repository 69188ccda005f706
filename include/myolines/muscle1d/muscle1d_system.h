// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle1d/hill_force.h>
#include <myolines/system/ledger.h>
#include <myolines/system/semi_discrete_system.h>
#include <myolines/system/zajac.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace myolines
{
  /// How the mass of a muscle is spread over its nodes.
  enum class MassOf
  {
    none,       ///< a massless spring
    points,     ///< equal masses on all free nodes, thesis (2.2.7), (3.2.1)
    lumped,     ///< that of the density, thesis (3.3.6), integrated on the nodes: diagonal
    consistent, ///< the same, integrated exactly
    blended     ///< a third of it consistent, the rest lumped: a third of the dispersion of the lumped one in waves on degree 1
  };

  class StoredBands;

  /// A tendon in series with the muscle; together they have a given length.
  struct Tendon
  {
    double                       optimal_length; ///< l_T [m]
    std::shared_ptr<const Drive> unit_length;    ///< L(t) of muscle and tendon [m]
  };

  /// What Muscle1dSystem is made of; the symbols are those of its equation.
  struct Muscle1dParameters
  {
    double       optimal_length  = 0.3; ///< l_M [m]
    double       maximum_force   = 525; ///< F_0 [N]
    double       mass            = 0;   ///< m [kg]
    double       initial_stretch = 1;   ///< of all elements
    unsigned int n_elements      = 1;   ///< in the length of the muscle
    unsigned int degree          = 1;   ///< of the elements
    double       grading         = 1; ///< length of the last element, at the tendon, over that of the first; in between a geometric series
    MassOf       mass_of         = MassOf::points; ///< how the mass is spread
    HillForce    force;                            ///< f(l, e, a)
    double       front_viscosity = 0;              ///< b [-] of Muscle1dSystem

    std::shared_ptr<const Drive> excitation; ///< none: unknown, the activation alone is given
    std::shared_ptr<const Drive> activation; ///< none: Zajac's equation is solved with the motion, for the excitation
    Zajac                        zajac;      ///< from excitation to activation
    std::optional<Tendon>        tendon;     ///< none: the end of the muscle is fixed

    std::vector<double> initial_displacement; ///< of the free nodes [m]; empty: none

    /// Stretch of all elements at which muscle and tendon balance at a time, with which a run begins that starts there; none: with the
    /// initial one.
    std::function<double(double)> balanced_stretch;
  };

  /// A muscle in one dimension, thesis chapters 2 and 3. Material coordinate X in (0, l_M), position x = l_0 X + u with the initial
  /// stretch l_0, u(0) = 0; stretch l = l_0 + u_X, strain rate e = l'/e_0, activation a(t):
  ///
  ///     (m/l_M) u_tt = F_X,   F = F_0 f(l, e, a),      F = F_0 F_T((L(t) - x(l_M))/l_T) at X = l_M, or u(l_M) = 0.
  ///
  /// Finite elements, all of equal length unless they are graded: of degree 1 with one Gauss point and equal masses at the free nodes this
  /// is the chain of N point masses between Hill springs of (2.2.7) and (3.2.1); of one element without mass it is the massless
  /// muscle-tendon unit (2.2.6), an equation of first order in u that is never solved for u': where the activation vanishes it becomes
  /// algebraic, and the matrices of implicit steps, K + C/(g dt), stay regular. Elements of degree k with k + 1 Gauss points and
  /// Gauss-Lobatto nodes discretise the continuum (3.3.6).
  ///
  /// Where the strain rate is beyond -1 or 1 force-velocity damps nothing, and fronts of much higher rates are an element or two wide;
  /// elements whose nodes are h apart may have an artificial viscosity there, a force that falls with h^2 and is zero elsewhere (von
  /// Neumann and Richtmyer 1950, doi:10.1063/1.1699639):
  ///
  ///     f + b Re (h/l_M)^2 (|e| - 8)^2 sign(e) for |e| > 8,   Re = m l_M e_0^2/F_0, the musculoskeletal Reynolds number.
  ///
  /// Unknowns: displacements of the free nodes [m] along the muscle, of second order, or of first order without mass. Where
  /// the activation is solved with the motion, each element has its own, of first order, before the nodes that end it; the unknown is
  /// l_M a [m], so that one norm fits all. Fixed nodes are no unknowns, and there are no constraints. Inadmissible: a stretch that
  /// is not positive. One rank computes it.
  class Muscle1dSystem : public SemiDiscreteSystem
  {
  public:
    /// @throws std::logic_error if the initial displacements are not as many as the free nodes.
    Muscle1dSystem(Muscle1dParameters parameters, WorkLedger &ledger);
    ~Muscle1dSystem() override;

    Capabilities                   capabilities() const override;
    std::size_t                    n_unknowns() const override { return layout_.size(); }
    State                          initial_state(double t0) const override;
    const Constraints             &constraints() const override { return constraints_; }
    void                           prescribed(double, Side, State &) const override {}
    Evaluation                     residual(const Point &point, Vector &r) const override;
    std::unique_ptr<Linearisation> make_linearisation() const override;
    void                           linearise(const Point &point, Linearisation &linearisation) const override;
    std::vector<double>            events(double t0, double t1) const override;

    const Muscle1dParameters &parameters() const { return parameters_; } ///< those of the constructor

    /// Lengths, forces, mass and Reynolds number that follow from the parameters, for `check`.
    std::vector<std::string> plan() const;

    // What a state says; the arguments are the u, or u and v, of the state.

    double              activation(double t, const Vector &u) const;     ///< given, or where it is solved that of the first element
    double              muscle_stretch(const Vector &u) const;           ///< of the whole muscle, x(l_M)/l_M
    double              muscle_strain_rate(const Vector &v) const;       ///< over e_0
    std::vector<double> element_stretches(const Vector &u) const;        ///< mean ones
    double              tendon_stretch(double t, const Vector &u) const; ///< with a tendon only

    /// Force over F_0 of every element, at its first Gauss point.
    std::vector<double> element_forces(double t, const Vector &u, const Vector &v) const;

  private:
    struct Element;

    bool         solves_activation() const { return parameters_.activation == nullptr; }
    unsigned int n_nodes() const { return parameters_.n_elements * parameters_.degree + 1; }
    bool         is_free(unsigned int node) const { return node > 0 && (node + 1 < n_nodes() || parameters_.tendon); }
    unsigned int of_node(unsigned int node) const;
    unsigned int of_activation(unsigned int element) const { return element * (parameters_.degree + 1); }
    double       end_displacement(const Vector &u) const { return parameters_.tendon ? u.local_element(of_node(n_nodes() - 1)) : 0; }
    double       element_activation(unsigned int element, double t, const Vector &u) const;
    hill::Curve  tendon(double t, Side side, double end_displacement) const; ///< over F_0, by its stretch

    double reynolds_number() const;
    /// Force over F_0 of an element, with the artificial viscosity of fronts; @p rate: of the stretch [1/s].
    HillForce::Value element_force(unsigned int element, double stretch, double rate, double activation) const;

    /// Adds the displacements of an even strain.
    void stretch_evenly(double strain, Vector &u) const;

    /// Values of all nodes, the fixed ones too.
    void scatter(const Vector &x, std::vector<double> &nodes) const;
    void add_mass(StoredBands &bands) const;
    void add_inertia(const Vector &acceleration, std::vector<double> &a, std::vector<double> &force) const;

    Muscle1dParameters             parameters_;
    WorkLedger                    &ledger_;
    std::unique_ptr<const Element> element_;     ///< of mean length
    std::vector<double>            lengths_;     ///< of the elements over the mean one
    double                         point_mass_;  ///< of a free node [kg]; of MassOf::points
    Constraints                    constraints_; ///< none
    Vector                         layout_;
  };
} // namespace myolines
