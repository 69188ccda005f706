#include <myolines/base/error.h>
#include <myolines/scene/numbers.h>
#include <myolines/time/loop.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// Times closer than this fraction of a step are one.
    constexpr double sliver = 1e-9;

    struct Landing
    {
      double t;  ///< end of the step [s]
      double dt; ///< t_now + dt == t in floating point [s]
    };

    class Loop
    {
    public:
      Loop(const SemiDiscreteSystem &system, Integrator &integrator, StepControl &control, const LoopSettings &settings, State &state,
           const std::vector<Observer *> &observers, WorkLedger &ledger, Keeper *keeper)
        : integrator_(integrator)
        , control_(control)
        , settings_(settings)
        , state_(state)
        , observers_(observers)
        , ledger_(ledger)
        , keeper_(keeper)
        , number_(settings.steps_done)
      {
        if (settings.events != Events::ignore)
          events_ = system.events(settings.start, settings.end);
        std::merge(events_.begin(), events_.end(), settings.landings.begin(), settings.landings.end(), std::back_inserter(landings_));
      }

      /// Tells keeper and observers how it ends; the errors thrown are those that all ranks agree on, or others.
      void run()
      {
        try
          {
            advance();
          }
        catch (const SolveError &error)
          {
            close(error.what());
            throw;
          }
        catch (const Interrupted &error)
          {
            close(error.what());
            throw;
          }
        catch (const std::exception &error)
          {
            tell_end(error.what());
            throw;
          }
        close("");
      }

    private:
      void advance()
      {
        if (state_.t == settings_.start)
          {
            integrator_.start(state_);
            for (Observer *observer : observers_)
              observer->begin(state_);
          }
        else
          for (Observer *observer : observers_)
            observer->resume(state_, number_);
        while (state_.t < settings_.end)
          {
            if (settings_.events == Events::restart && at_event() && restarted_at_ != state_.t)
              {
                ledger_.count("restarts at events");
                integrator_.start(state_);
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
        tell_end(reason);
      }

      void tell_end(const std::string &reason)
      {
        for (Observer *observer : observers_)
          observer->end(reason);
      }

      bool at_event() const { return std::binary_search(events_.begin(), events_.end(), state_.t); }

      /// The earliest of what must be landed on; of times that agree up to a sliver the one known best wins:
      /// an event or another given time before a planned step, the end before both.
      Landing landing() const
      {
        const double t        = state_.t;
        double       proposed = control_.propose(t);
        const double merge    = sliver * proposed;
        double       target   = control_.next_landing(t);
        const auto   fixed    = std::upper_bound(landings_.begin(), landings_.end(), t);
        const bool   planned  = std::isfinite(target);
        if (fixed != landings_.end() && *fixed <= target + merge)
          target = *fixed;
        if (settings_.end <= target + merge)
          target = settings_.end;
        if (!planned && target - t < 2 * proposed && target - t > proposed + merge)
          proposed = (target - t) / 2; // rather two equal steps than a long and a very short one
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

      void attempt()
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
        for (Observer *observer : observers_)
          observer->accepted(state_, record);
        if (keeper_ != nullptr && state_.t < settings_.end)
          if (const std::optional<std::string> reason = keeper_->accepted(state_, number_))
            throw Interrupted(*reason);
      }

      void reject(StepRecord &record)
      {
        ledger_.count("rejected steps");
        record.number = number_;
        for (Observer *observer : observers_)
          observer->rejected(record);
        if (control_.rejected(state_.t, record.dt, record.report))
          return;
        std::ostringstream text;
        text << "The step from t = " << state_.t << " s of size " << record.dt << " s failed: " << record.report.reason
             << ". To try: " << control_.advice() << ".";
        throw SolveError(text.str());
      }

      Integrator                    &integrator_;
      StepControl                   &control_;
      const LoopSettings            &settings_;
      State                         &state_;
      const std::vector<Observer *> &observers_;
      WorkLedger                    &ledger_;
      Keeper                        *keeper_;
      std::vector<double>            events_;
      std::vector<double>            landings_; ///< events and others
      std::size_t                    number_;
      std::optional<double>          restarted_at_; ///< once, also if steps from there are repeated
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
    Loop(system, integrator, control, settings, state, observers, ledger, keeper).run();
  }
} // namespace myolines
