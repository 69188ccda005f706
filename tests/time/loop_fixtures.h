// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/matrices.h"
#include "../support/solvers.h"

#include <myolines/base/error.h>
#include <myolines/time/loop.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  /// A system of which the loop sees only the events.
  class Eventful : public SemiDiscreteSystem
  {
  public:
    explicit Eventful(std::vector<double> times)
      : times_(std::move(times))
    {}
    Capabilities       capabilities() const override { return {}; }
    std::size_t        n_unknowns() const override { return 1; }
    State              initial_state(double t0) const override { return {t0, serial_vector(1), serial_vector(1), serial_vector(1)}; }
    const Constraints &constraints() const override { return none_; }
    void               prescribed(double, Side, State &) const override {}
    Evaluation         residual(const Point &, Vector &) const override { return {}; }
    std::unique_ptr<Linearisation> make_linearisation() const override { return nullptr; }
    void                           linearise(const Point &, Linearisation &) const override {}

    std::vector<double> events(const double t0, const double t1) const override
    {
      std::vector<double> inside;
      std::copy_if(times_.begin(), times_.end(), std::back_inserter(inside), [=](double t) { return t0 < t && t < t1; });
      return inside;
    }

  private:
    std::vector<double> times_;
    Constraints         none_;
  };

  /// Counts its steps in u and fails where told to.
  class Fake : public Integrator
  {
  public:
    std::function<bool(double t, double dt)> fails = [](double, double) { return false; };
    std::vector<double>                      starts;
    std::vector<double>                      ends;
    std::vector<double>                      sizes;

    void start(State &state) override { starts.push_back(state.t); }

    StepReport step(const double dt, State &state) override
    {
      StepReport report;
      report.error_estimate = 1;
      if (fails(state.t, dt))
        {
          report.outcome = StepReport::Outcome::not_converged;
          report.reason  = "on demand";
          return report;
        }
      state.t += dt;
      state.u(0) += 1;
      ends.push_back(state.t);
      sizes.push_back(dt);
      return report;
    }

    void save(Archive &) const override {}
    void load(const Archive &) override {}
  };

  class Recorder : public Observer
  {
  public:
    void begin(const State &) override { ++begun; }
    void accepted(const State &state, const StepRecord &record) override
    {
      EXPECT_EQ(state.t, record.t);
      times.push_back(record.t);
      numbers.push_back(record.number);
    }
    void rejected(const StepRecord &record) override { rejections.push_back(record); }
    void end(const std::string &why) override
    {
      ++ended;
      reason = why;
    }

    unsigned int             begun = 0, ended = 0;
    std::vector<double>      times;
    std::vector<std::size_t> numbers;
    std::vector<StepRecord>  rejections;
    std::string              reason;
  };

  struct Trial
  {
    Fake       fake;
    Recorder   recorder;
    WorkLedger ledger;
    State      state;

    void go(const Overrides &overrides, const std::vector<double> &events = {})
    {
      const scene::Node time = node(time_schema(), overrides);
      const Eventful    system(events);
      const auto        control = make_step_control(time, 2);
      if (state.u.size() == 0)
        state = system.initial_state(time.number("start"));
      run_loop(system, fake, *control, loop_settings(time), state, {&recorder}, ledger);
    }
  };
} // namespace
