// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/integrators/sundials_tools.h>
#include <myolines/integrators/sundials_versions.h>
#include <myolines/time/error_control.h>
#include <myolines/time/integrator.h>

#include <optional>

namespace myolines
{
  /// What the solvers of SUNDIALS (doi:10.1145/1089014.1089020) share that choose their steps: the system in first-order form,
  /// tolerances, stops at given times, what they tell of a step.
  ///
  /// Inadmissible states are recoverable failures: the solver tries a shorter step. Histories are its own: after load() the method
  /// begins anew, with the step that would have been the next one.
  ///
  /// Ledger: "rejected steps" (error too large), "nonlinear convergence failures".
  class SundialsIntegrator : public SelfPacedIntegrator
  {
  public:
    void       start(State &state) final;
    StepReport advance(double t_stop, State &state) final;
    void       save(Archive &archive) const final;
    void       load(const Archive &archive) final;

    static constexpr unsigned int steps_between_looks = 100; ///< after which refusal() is asked again

  protected:
    /// What allocate_solver() needs is made at the first start().
    SundialsIntegrator(const IntegratorContext &context, const ErrorControlLimits &limits);

    /// Totals since begin().
    struct Statistics
    {
      long   error_failures  = 0; ///< attempts whose error was too large
      long   solver_failures = 0; ///< attempts whose equations were not solved
      double estimated_error = 0; ///< of the last step, relative to the tolerances
    };

    /// Begins anew at (t, y(), dy()); the first step [s] is @p first_step, or its own choice (0).
    virtual void begin(double t, double first_step) = 0;

    /// Why the method cannot go from (t, y()) to @p t_stop at a bearable cost; empty: it can. Asked at begin() and after every
    /// steps_between_looks steps.
    virtual std::string refusal(double /*t*/, double /*t_stop*/) { return ""; }

    /// One step to @p t <= @p t_stop: y() and dy() become those there. Negative: failed.
    virtual int evolve(double t_stop, double &t) = 0;

    virtual Statistics statistics() const                   = 0; ///< of the solver
    virtual double     next_step() const                    = 0; ///< [s]
    virtual void       allocate_solver(const State &layout) = 0; ///< once

    FirstOrderForm           &form() const { return *form_; }         ///< the system
    const SundialsContext    &sundials() const { return *sundials_; } ///< the session
    const ErrorControlLimits &limits() const { return limits_; }      ///< of the scene
    const IntegratorContext  &context() const { return context_; }    ///< of the constructor
    const ErrorTolerances    &tolerances() const;                     ///< of the scene
    N_Vector                  y() const { return y_.get(); }          ///< (u, v) of the free unknowns now
    N_Vector                  dy() const { return dy_.get(); }        ///< (u', v') of them

    /// The size of @p error relative to the tolerances at y(), as set_error_weights() says.
    double   size(N_Vector error) const;
    N_Vector work() const { return work_.get(); } ///< a vector for calls of the moment

    /// What SUNDIALS said of the last failure: MYOLINES_KEEP_SUNDIALS_ERRORS writes it.
    std::string &message() { return message_; }

  private:
    void allocate(const State &state);
    void begin_at(const State &state, double first_step);

    const IntegratorContext          context_;
    const ErrorControlLimits         limits_;
    std::unique_ptr<FirstOrderForm>  form_;
    std::unique_ptr<SundialsContext> sundials_;
    SundialsVector                   y_, dy_, work_, weights_;
    Statistics                       counted_;
    unsigned int                     steps_since_look_ = 0;
    std::optional<double>            step_after_load_; ///< [s]
    bool                             begun_ = false, started_ = false;
    std::string                      message_;
  };
} // namespace myolines
