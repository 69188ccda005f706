// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/loop.h>

namespace myolines
{
  /// Writes at the start, after every `every` accepted steps, and the state that the run ends with. In a resumed run the
  /// latter gives way to what follows.
  class PeriodicOutput : public Observer
  {
  public:
    explicit PeriodicOutput(const std::size_t every)
      : every_(every)
    {}

    void begin(const State &state) final { write(state, Side::right, 0); }
    void resume(const State &, const std::size_t step) final { step_ = step; }

    void accepted(const State &state, const StepRecord &record) final
    {
      step_ = record.number;
      if (due())
        write(state, Side::left, step_);
      else
        pass(state);
    }

    void last(const State &state) final
    {
      if (!due())
        write(state, Side::left, step_);
    }

    void measure(const State &state, const Side side) final { write(state, side, step_); }

  protected:
    virtual void write(const State &state, Side side, std::size_t step) = 0;

    /// After an accepted step without output: for what must be followed in time.
    virtual void pass(const State &) {}

  private:
    bool due() const { return step_ % every_ == 0; }

    std::size_t every_;
    std::size_t step_ = 0;
  };
} // namespace myolines
