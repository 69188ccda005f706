// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/registry.h>
#include <myolines/scene/scene.h>
#include <myolines/solve/nonlinear_solver.h>
#include <myolines/system/semi_discrete_system.h>
#include <myolines/time/memory.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// Facts about a method, for `list`, `check`, the documentation and the verification suite.
  struct MethodFacts
  {
    std::string  name;           ///< as in a scene: "backward euler"
    std::string  summary;        ///< one sentence
    std::string  reference;      ///< paper with DOI, or thesis equation
    unsigned int order = 1;      ///< order of accuracy of u and v on smooth problems; 0: no dynamics
    std::string  stability;      ///< "L-stable", ...
    bool         dynamic = true; ///< false: ignores inertia and rates

    /// What the method estimates of the error of a step is of order dt^k; 0: it has no estimate of its own.
    unsigned int error_exponent = 0;

    /// Without an estimate of its own: steps may be taken whole and in halves to make one. Not if formulas of equal steps lose their order.
    bool doubles = true;

    /// The estimate is of u and v, else of u only.
    bool estimates_velocity = true;

    /// Which unknowns a method takes. Those of order 0 or 1, all of them in a system without inertia, have no accelerations M a = -F.
    enum class Unknowns
    {
      every_order,                      ///< algebraic, first and second order
      every_order_if_damped,            ///< where its parameters damp accelerations, else of second order
      first_or_second_order,            ///< all of second order with inertia, or all of first order
      second_order                      ///< with inertia only
    } unknowns = Unknowns::every_order; ///< which unknowns the method takes

    /// Keeps waves that its steps resolve better than any other method that damps those of infinite frequency.
    bool least_damping = false;

    bool two_states = false; ///< takes forces of two states, see Point::before, of systems that are not linear

    /// The method has formulas of its own for the velocity and acceleration of a moving boundary, see BoundaryRates::scheme.
    bool scheme_rates = true;

    /// What a step solves, which says what limits its size.
    enum class Solves
    {
      nonlinear_equations,                  ///< iterates until they hold: nothing but accuracy
      linear_systems,                       ///< linearly implicit, no iteration: what is left of nonlinear equations is never looked at
      mass                                  ///< explicit: stability
    } solves = Solves::nonlinear_equations; ///< what a step solves

    /// After load(): exact (bit-equal) or reinitialised (history is lost).
    enum class Restart
    {
      exact,                    ///< the next step is bit-equal
      reinitialise              ///< history is lost, and the method begins anew
    } restart = Restart::exact; ///< what load() gives back
  };

  /// How the velocity and acceleration of moving boundaries are made.
  enum class BoundaryRates
  {
    exact, ///< analytic derivatives of the prescribed motion
    scheme ///< the method's own difference formulas
  };

  /// What the free unknowns feel of a moving boundary that starts, or jumps to another velocity, at the beginning of a smooth
  /// piece. The two are limits of the continuous problem as the jump becomes abrupt, and of none (errata 21).
  enum class StartVelocity
  {
    consistent, ///< nothing: velocities of free unknowns stay as they are, the boundary has the right limit
    impulse     ///< the impulse of the consistent mass; with scheme rates the boundary itself starts from rest
  };

  /// How a step ended. Failure is a value, never an exception.
  struct StepReport
  {
    /// What became of the step.
    enum class Outcome
    {
      accepted,        ///< the state is at the end of the step
      not_converged,   ///< the nonlinear or a linear solver has failed
      inadmissible,    ///< no state with det F > 0 was found
      error_too_large, ///< the estimate exceeds the tolerance
      energy_gained    ///< the balance of energy gained too much
    };
    Outcome               outcome = Outcome::accepted; ///< what became of the step
    std::string           reason;                      ///< why it was not accepted; else empty
    std::string           advice;                      ///< what may help, beside what the control of steps says
    bool                  shorter_steps        = true; ///< whether that may help
    unsigned int          newton_iterations    = 0;    ///< of all stages
    unsigned int          linear_iterations    = 0;    ///< in all of them
    unsigned int          residual_evaluations = 0;    ///< those of line searches among them
    std::optional<double> initial_residual;            ///< l2 over free unknowns after the lift, of methods that iterate
    std::optional<double> final_residual;              ///< the same at the end
    std::optional<double> longest_step;                ///< that the method takes from here [s], where a step was refused for its length
    std::optional<double> error_estimate;              ///< relative to the tolerances, if the method estimates it

    bool accepted() const { return outcome == Outcome::accepted; } ///< whether the state is at the end of the step
  };

  class ErrorNorm;
  struct ErrorControlLimits;

  /// What every integrator gets to work with. All references outlive the integrator.
  struct IntegratorContext
  {
    const SemiDiscreteSystem &system;                                     ///< what is advanced
    NonlinearSolver          &solver;                                     ///< for implicit stages
    BoundaryRates             boundary_rates;                             ///< of the scene
    WorkLedger               &ledger;                                     ///< for counts
    StartVelocity             start_velocity = StartVelocity::consistent; ///< of the scene

    /// Given: steps are estimated and refused (Outcome::error_too_large) where the norm exceeds 1, and nonlinear solves are as
    /// accurate as that needs. None: nothing is estimated.
    const ErrorNorm *error_norm = nullptr;

    Vector make_vector() const; ///< zeros in the layout of the vectors of states
    State  make_state() const;  ///< zeros at time 0
  };

  /// What advances a state in time.
  /// - start(state): state.t, u, v hold the beginning of a smooth piece (the initial time or a kink). The method
  ///   prepares what it needs (accelerations, empty history). Call again after every event at which the loop restarts.
  /// - remember(memory): keeps everything beyond the state that the next step depends on, by names. A method without memory has nothing to
  ///   say. Those that wrap another one, or keep what is neither number nor vector, override save and load instead.
  class TimeMethod
  {
  public:
    virtual ~TimeMethod() = default;

    virtual void start(State &state) = 0; ///< a smooth piece begins at @p state

    ///@{
    /// Tells what is kept from step to step.
    virtual void remember(Memory &) {}

    virtual void save(Archive &archive) const;
    virtual void load(const Archive &archive);
    ///@}
  };

  /// One-step contract.
  /// - step(dt, state): on entry t, u, v, a are the last accepted step; on return with Outcome::accepted they are at
  ///   exactly t + dt, else bit-equal to entry. Never changes dt, never loops over steps, never prints.
  class Integrator : public TimeMethod
  {
  public:
    virtual StepReport step(double dt, State &state) = 0; ///< one step of @p dt > 0 [s]
  };

  /// Methods whose steps are their own choice.
  /// - advance(t_stop, state): one step from state.t to a later time, at most @p t_stop, and @p t_stop bit for bit where it
  ///   reaches it. On return with Outcome::accepted state is there, else bit-equal to entry and the method is at its end: its own
  ///   attempts with shorter steps have failed. Attempts that it rejected are counted in the ledger, "rejected steps".
  class SelfPacedIntegrator : public TimeMethod
  {
  public:
    virtual StepReport advance(double t_stop, State &state) = 0; ///< one step, to @p t_stop [s] at most
  };

  /// What one file in integrators/ provides: facts, parameters, and how to make one, or both kinds.
  struct IntegratorEntry
  {
    MethodFacts   facts;  ///< of the defaults
    scene::Schema schema; ///< of its parameters

    /// Of a system that fits the facts: see make_integrator(), which looks at that, and is what others call.
    std::function<std::unique_ptr<Integrator>(const scene::Node &, const IntegratorContext &)> make;

    /// Where steps are chosen by error, for methods that do so themselves: the context has an error norm, and the limits are those of
    /// the scene. Empty: ErrorControl chooses. A method with this only, without make(), is refused where steps are given.
    std::function<std::unique_ptr<SelfPacedIntegrator>(const scene::Node &, const IntegratorContext &, const ErrorControlLimits &)>
        make_self_paced;

    /// The facts where they depend on the parameters; empty: `facts`, which are those of the defaults. See facts_with().
    std::function<MethodFacts(const scene::Node &)> facts_of_parameters;

    /// What follows from the parameters, for `check`: coefficients, order, stability. Empty: nothing.
    std::function<std::vector<std::string>(const scene::Node &)> derived;
  };

  inline void TimeMethod::save(Archive &archive) const
  {
    Memory memory = Memory::into(archive);
    const_cast<TimeMethod *>(this)->remember(memory); // which changes nothing on this way
  }

  inline void TimeMethod::load(const Archive &archive)
  {
    Memory memory = Memory::out_of(archive);
    remember(memory);
  }

  /// Facts of the method with the parameters of @p integrator.
  MethodFacts facts_with(const IntegratorEntry &entry, const scene::Node &integrator);

  inline const std::string &name_of(const IntegratorEntry &entry) { return entry.facts.name; } ///< For Registry.

  /// All integrators of integrators/list.def, in its order, then those of plug-ins.
  Registry<IntegratorEntry> &integrator_registry();

  /// The entry whose facts.name is @p name. @throws std::out_of_range.
  const IntegratorEntry &integrator_entry(const std::string &name);
} // namespace myolines
