// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/instants.h>
#include <myolines/time/loop.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace myolines
{
  /// Writes at the start, after every `every` accepted steps, and the state that the run ends with. In a resumed run the
  /// latter gives way to what follows. With instants it writes there, and nowhere else.
  class PeriodicOutput : public Observer
  {
  public:
    /// @p every steps, > 0, or at the @p instants [s], ascending.
    explicit PeriodicOutput(const std::size_t every, std::vector<double> instants = {})
      : every_(every)
      , instants_(std::move(instants))
    {}

    std::vector<double> landings() const final { return instants_; }

    void begin(const State &state) final
    {
      if (due(state.t, 0))
        write(state, Side::right, 0);
    }
    void resume(const State &, const std::size_t step) final { step_ = step; }

    void accepted(const State &state, const StepRecord &record) final
    {
      step_ = record.number;
      if (due(state.t, record.dt))
        write(state, Side::left, step_);
      else
        pass(state);
    }

    void last(const State &state) final
    {
      if (instants_.empty() && !due(state.t, 0))
        write(state, Side::left, step_);
    }

    void measure(const State &state, const Side side) final { write(state, side, step_); }

  protected:
    virtual void write(const State &state, Side side, std::size_t step) = 0; ///< @p step: accepted steps so far; loads are those of @p side

    /// After an accepted step without output: for what must be followed in time.
    virtual void pass(const State &) {}

  private:
    bool due(const double t, const double dt) const
    {
      return instants_.empty() ? step_ % every_ == 0
                               : std::any_of(instants_.begin(), instants_.end(), [&](const double at) { return same_time(at, t, dt); });
    }

    std::size_t         every_;
    std::vector<double> instants_;
    std::size_t         step_ = 0;
  };
} // namespace myolines
