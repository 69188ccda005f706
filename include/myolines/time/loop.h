// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/energy_balance.h>
#include <myolines/time/integrator.h>
#include <myolines/time/step_control.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// How the loop treats kinks of the drives.
  enum class Events
  {
    restart, ///< land on them and restart the integrator with right limits
    land,    ///< land on them only
    ignore   ///< steps go across them
  };

  /// One attempted step, for observers and steps.csv.
  struct StepRecord
  {
    std::size_t number = 0; ///< accepted steps so far, this one included if accepted
    double      t      = 0; ///< end of the step [s]
    double      dt     = 0; ///< [s]
    StepReport  report;     ///< how it ended
  };

  /// Watches a run. Observers never change the state or the steps.
  class Observer
  {
  public:
    virtual ~Observer() = default;
    virtual void begin(const State &) {}                                         ///< initial state, before the first step
    virtual void resume(const State &, std::size_t /*accepted steps so far*/) {} ///< instead of begin() in a resumed run
    virtual void restarting(const State &) {}                                    ///< at an event: the state with left limits
    virtual void restarted(const State &) {}                                     ///< then: with right limits
    virtual void accepted(const State &, const StepRecord &) {}                  ///< after every accepted step
    virtual void rejected(const StepRecord &) {}                                 ///< after every rejected attempt

    /// The state a run ended with: done, stopped, or unable to go on; the last one accepted. Not after other errors,
    /// of which other ranks may not know.
    virtual void last(const State &) {}
    virtual void end(const std::string & /*reason*/) {} ///< always called, also after a failure; "" if done

    /// Times at which it must see a state [s], to be landings of the loop.
    virtual std::vector<double> landings() const { return {}; }
    /// Outside of a run: its row at @p state, with the loads of @p side, whatever its instants are. Nothing for those that have no rows, or
    /// only rows that tell of what went before.
    virtual void measure(const State &, Side) {}

    /// What it knows of the balance of energy, nullptr: nothing.
    virtual const EnergyBalance *energy_balance() const { return nullptr; }

    /// What the observer must remember where a run is resumed. It gets it back when it is made.
    virtual void save(Archive &) const {}
  };

  /// Keeps a run, so that it can be resumed, and may end it. The loop calls it on all ranks alike.
  class Keeper
  {
  public:
    virtual ~Keeper() = default;

    /// The run begins with this state, after its observers; not in a resumed run.
    virtual void begun(const State &) {}

    /// After every accepted step, after its observers.
    virtual void accepted(const State &state, std::size_t step) = 0;

    /// Asked after every accepted step but the last, and after every attempt that failed. A text ends the run: why.
    virtual std::optional<std::string> reason_to_stop(const State &state, std::size_t step) = 0;

    /// The run ends with this last accepted state: done, stopped, or unable to go on; before the observers know.
    virtual void ended(const State &state, std::size_t step) = 0;
  };

  /// From when to when a run goes, and where it must land.
  struct LoopSettings
  {
    double              start  = 0;               ///< [s]
    double              end    = 0;               ///< [s]
    Events              events = Events::restart; ///< how kinks are treated
    std::vector<double> landings;                 ///< further times to land on [s], ascending
    std::size_t         steps_done = 0;           ///< accepted steps before the given state, of a resumed run
    bool                resumed    = false;       ///< integrator and control have been loaded
  };
  /// @throws InputError if `land on` holds what is no time between start and end.
  LoopSettings loop_settings(const scene::Node &time);

  /// Advances @p state to settings.end exactly: lands on the end, on the landings of the control and of the settings, and
  /// (unless ignored) on events; restarts the integrator after events where so set. A remainder within time_tolerance is
  /// merged into the step, so that rounding makes no sliver steps. Landing times are set, never accumulated.
  ///
  /// The state begins the run, the integrator is started; or it resumes one, integrator and control having been loaded, that goes on as if
  /// it had not stopped.
  ///
  /// Ledger: "accepted steps", "rejected steps", "restarts at events".
  /// @throws SolveError with reason, time and last step size when the control gives up, Interrupted when the keeper ends the
  /// run, SystemError with step and time where the system refuses (on the ranks that notice); observers were told before. What fails while
  /// the run is closed is told behind the reason, as OnOneRank.
  void run_loop(const SemiDiscreteSystem &system, Integrator &integrator, StepControl &control, const LoopSettings &settings, State &state,
                const std::vector<Observer *> &observers, WorkLedger &ledger, Keeper *keeper = nullptr);

  /// The same with a method that chooses its steps itself: it stops at events (unless ignored), at the landings and at the end.
  /// A step that fails ends the run.
  void run_loop(const SemiDiscreteSystem &system, SelfPacedIntegrator &integrator, const LoopSettings &settings, State &state,
                const std::vector<Observer *> &observers, WorkLedger &ledger, Keeper *keeper = nullptr);
} // namespace myolines
