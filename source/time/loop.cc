// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/on_one_rank.h>
#include <myolines/scene/numbers.h>
#include <myolines/time/loop.h>
#include <myolines/time/plan.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <sstream>

namespace myolines
{
  namespace
  {
    struct Landing
    {
      double t;  ///< end of the step [s]
      double dt; ///< t_now + dt == t in floating point [s]
    };

    /// What all runs share; how a step is taken is up to the derived class.
    class Loop
    {
    public:
      Loop(const SemiDiscreteSystem &system, TimeMethod &method, const LoopSettings &settings, State &state,
           const std::vector<Observer *> &observers, WorkLedger &ledger, Keeper *keeper)
        : settings_(settings)
        , state_(state)
        , observers_(observers)
        , ledger_(ledger)
        , number_(settings.steps_done)
        , method_(method)
        , keeper_(keeper)
        , rounding_(time_tolerance(std::max(std::abs(settings.start), std::abs(settings.end)), 0))
      {
        if (settings.events != Events::ignore)
          events_ = system.events(settings.start, settings.end);
      }
      virtual ~Loop() = default;

      /// Tells keeper and observers how it ends; the errors thrown are those that all ranks agree on, or others. What fails while the end
      /// is told never hides why the run ends.
      void run()
      {
        try
          {
            advance();
          }
        catch (const SolveError &error)
          {
            close_and_throw<SolveError>(error.what());
          }
        catch (const Interrupted &error)
          {
            close_and_throw<Interrupted>(error.what());
          }
        catch (const SystemError &error)
          {
            throw SystemError(refused(error.what()), error.error_number());
          }
        catch (const std::bad_alloc &)
          {
            throw SystemError(refused("out of memory"), ENOMEM);
          }
        catch (const std::exception &error)
          {
            tell_end(error.what());
            throw;
          }
        try
          {
            close("");
          }
        catch (const SystemError &error)
          {
            throw SystemError(refused(error.what()), error.error_number());
          }
      }

    protected:
      virtual void attempt() = 0;

      /// What must be landed on next: an event, a given time, or the end. Events that are not the same instant are distinct however short
      /// the steps between them, and of those that are the last one counts; given times give way to events and to the end where they agree
      /// with them within the tolerance of a step of @p size.
      double next_fixed(const double size) const
      {
        const double tolerance = std::max(time_tolerance(state_.t, size), rounding_);
        const double event = next(events_, rounding_), given = next(settings_.landings, tolerance);
        if (given < event - tolerance)
          return given < settings_.end - tolerance ? given : settings_.end;
        if (!std::isfinite(event))
          return settings_.end;
        const double last = *std::prev(std::upper_bound(events_.begin(), events_.end(), event + rounding_));
        return last < settings_.end - rounding_ ? last : settings_.end;
      }

      void tell_accepted(const StepRecord &record)
      {
        for (Observer *observer : observers_)
          observer->accepted(state_, record);
        if (keeper_ == nullptr || state_.t >= settings_.end)
          return;
        keeper_->accepted(state_, number_);
        stop_if_asked();
      }

      /// A signal makes solves fail.
      void stop_if_asked() const
      {
        if (keeper_ != nullptr)
          if (const std::optional<std::string> reason = keeper_->reason_to_stop(state_, number_))
            throw Interrupted(*reason);
      }

      void tell_rejected(const StepRecord &record)
      {
        ledger_.count("rejected steps");
        for (Observer *observer : observers_)
          observer->rejected(record);
      }

      [[noreturn]] void give_up(const std::string &step, const std::string &reason, const std::string &advice) const
      {
        throw SolveError("The step from t = " + text(state_.t) + " s" + step + " failed: " + reason + ". To try: " + advice + ".");
      }

      static std::string text(const double x)
      {
        std::ostringstream stream;
        stream << x;
        return stream.str();
      }

      const LoopSettings            &settings_;
      State                         &state_;
      const std::vector<Observer *> &observers_;
      WorkLedger                    &ledger_;
      std::size_t                    number_;

    private:
      void advance()
      {
        if (!settings_.resumed && state_.t == settings_.start)
          {
            method_.start(state_);
            for (Observer *observer : observers_)
              observer->begin(state_);
            if (keeper_ != nullptr)
              keeper_->begun(state_);
          }
        else
          for (Observer *observer : observers_)
            observer->resume(state_, number_);
        while (state_.t < settings_.end)
          {
            if (settings_.events == Events::restart && at_event() && restarted_at_ != state_.t)
              {
                ledger_.count("restarts at events");
                for (Observer *observer : observers_)
                  observer->restarting(state_);
                method_.start(state_);
                restarted_at_ = state_.t;
                for (Observer *observer : observers_)
                  observer->restarted(state_);
              }
            attempt();
          }
      }

      void close(const std::string &reason)
      {
        if (keeper_ != nullptr)
          keeper_->ended(state_, number_);
        for (Observer *observer : observers_)
          observer->last(state_);
        for (Observer *observer : observers_)
          observer->end(reason);
      }

      /// Closes the run that ends for @p reason. What fails then stands behind it; other ranks do not know of that.
      template <typename Error>
      [[noreturn]] void close_and_throw(const std::string &reason)
      {
        try
          {
            close(reason);
          }
        catch (const SystemError &error)
          {
            const std::string both = reason + "\nNot everything could be saved: " + error.what();
            tell_end(both);
            throw OnOneRank<Error>(both);
          }
        throw Error(reason);
      }

      /// The system refused, on one rank perhaps. Returns the reason with step and time.
      std::string refused(const std::string &what)
      {
        const std::string reason = what + ", after step " + std::to_string(number_) + " at t = " + text(state_.t) + " s";
        tell_end(reason);
        return reason;
      }

      /// After a failure: whatever fails now is its consequence.
      void tell_end(const std::string &reason)
      {
        for (Observer *observer : observers_)
          try
            {
              observer->end(reason);
            }
          catch (const SystemError &)
            {}
      }

      /// The first of @p times behind the present one, or infinity.
      double next(const std::vector<double> &times, const double tolerance) const
      {
        const auto first = std::upper_bound(times.begin(), times.end(), state_.t + tolerance);
        return first == times.end() ? std::numeric_limits<double>::infinity() : *first;
      }

      bool at_event() const { return std::binary_search(events_.begin(), events_.end(), state_.t); }

      TimeMethod           &method_;
      Keeper               *keeper_;
      std::vector<double>   events_;
      double                rounding_;     ///< of times of the run [s]
      std::optional<double> restarted_at_; ///< once, also if steps from there are repeated
    };

    /// Steps that a control proposes.
    class ControlledLoop : public Loop
    {
    public:
      ControlledLoop(const SemiDiscreteSystem &system, Integrator &integrator, StepControl &control, const LoopSettings &settings,
                     State &state, const std::vector<Observer *> &observers, WorkLedger &ledger, Keeper *keeper)
        : Loop(system, integrator, settings, state, observers, ledger, keeper)
        , integrator_(integrator)
        , control_(control)
      {}

    private:
      /// The earliest of what must be landed on; of times that agree within time_tolerance the one known best wins:
      /// an event or another given time before a planned step, the end before both.
      Landing landing() const
      {
        const double t        = state_.t;
        double       proposed = control_.propose(t);
        const double merge    = time_tolerance(t, proposed);
        double       target   = control_.next_landing(t);
        const bool   planned  = std::isfinite(target);
        const double fixed    = next_fixed(proposed);
        if (fixed <= target + merge)
          target = fixed;
        if (!planned && target - t < 2 * proposed && target - t > proposed + merge)
          proposed = (target - t) / 2; // rather two equal steps than a long and a tiny one
        if (t + proposed < target - merge)
          target = t + proposed;
        return {target, exact_difference(t, target)};
      }

      /// dt with t + dt == end in floating point: instants of the last stage must lie on the kink, not beside it.
      static double exact_difference(const double t, const double end)
      {
        double dt = end - t;
        while (t + dt < end)
          dt = std::nextafter(dt, 2 * dt);
        while (t + dt > end)
          dt = std::nextafter(dt, 0.);
        return dt;
      }

      void attempt() override
      {
        const Landing next = landing();
        StepRecord    record;
        record.t      = next.t;
        record.dt     = next.dt;
        record.report = integrator_.step(next.dt, state_);
        if (record.report.accepted())
          accept(record);
        else
          reject(record);
      }

      void accept(StepRecord &record)
      {
        ledger_.count("accepted steps");
        state_.t      = record.t;
        record.number = ++number_;
        control_.accepted(record.t, record.dt, record.report);
        tell_accepted(record);
      }

      void reject(StepRecord &record)
      {
        stop_if_asked();
        record.number = number_;
        tell_rejected(record);
        if (!control_.rejected(state_.t, record.dt, record.report))
          give_up(" of size " + text(record.dt) + " s", record.report.reason, advice(record.report));
      }

      std::string advice(const StepReport &report) const
      {
        if (report.advice.empty())
          return control_.advice();
        return report.shorter_steps ? report.advice + ", or " + control_.advice() : report.advice;
      }

      Integrator  &integrator_;
      StepControl &control_;
    };

    /// Steps that the method chooses.
    class SelfPacedLoop : public Loop
    {
    public:
      SelfPacedLoop(const SemiDiscreteSystem &system, SelfPacedIntegrator &integrator, const LoopSettings &settings, State &state,
                    const std::vector<Observer *> &observers, WorkLedger &ledger, Keeper *keeper)
        : Loop(system, integrator, settings, state, observers, ledger, keeper)
        , integrator_(integrator)
      {}

    private:
      void attempt() override
      {
        const double begin = state_.t;
        StepRecord   record;
        record.report = integrator_.advance(next_fixed(0), state_);
        record.number = number_;
        record.t      = state_.t;
        record.dt     = state_.t - begin;
        if (!record.report.accepted())
          {
            stop_if_asked();
            tell_rejected(record);
            give_up("", record.report.reason,
                    "other tolerances or a smaller \"minimum step\" in \"time/control\", velocities among them, or another method");
          }
        ledger_.count("accepted steps");
        record.number = ++number_;
        tell_accepted(record);
      }

      SelfPacedIntegrator &integrator_;
    };
  } // namespace

  namespace
  {
    std::vector<double> landings(const scene::Node &time, const LoopSettings &settings)
    {
      std::vector<double> times;
      std::istringstream  words(time.text("land on"));
      for (std::string word; words >> word;)
        {
          const std::optional<double> t = scene::parse_number(word);
          if (!t || *t <= settings.start || *t > settings.end)
            time.refuse("land on", "\"" + word + "\" is not a time between \"start\" and \"end\"", "times [s] separated by spaces",
                        "for example \"0.1 0.25\"");
          times.push_back(*t);
        }
      std::sort(times.begin(), times.end());
      return times;
    }
  } // namespace

  LoopSettings loop_settings(const scene::Node &time)
  {
    LoopSettings settings;
    settings.start           = time.number("start");
    settings.end             = time.number("end");
    const std::string events = time.text("events");
    settings.events          = events == "restart" ? Events::restart : events == "land" ? Events::land : Events::ignore;
    if (time.has("land on"))
      settings.landings = landings(time, settings);
    return settings;
  }

  void run_loop(const SemiDiscreteSystem &system, Integrator &integrator, StepControl &control, const LoopSettings &settings, State &state,
                const std::vector<Observer *> &observers, WorkLedger &ledger, Keeper *keeper)
  {
    ControlledLoop(system, integrator, control, settings, state, observers, ledger, keeper).run();
  }

  void run_loop(const SemiDiscreteSystem &system, SelfPacedIntegrator &integrator, const LoopSettings &settings, State &state,
                const std::vector<Observer *> &observers, WorkLedger &ledger, Keeper *keeper)
  {
    SelfPacedLoop(system, integrator, settings, state, observers, ledger, keeper).run();
  }
} // namespace myolines
