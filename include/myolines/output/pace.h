// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/loop.h>

#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// Whether steps that are chosen by error have become so short that the run takes far longer than its beginning lets expect.
  class Pace
  {
  public:
    /// Of a run until @p end [s].
    explicit Pace(double end)
      : end_(end)
    {}

    void rejected(const StepRecord &record); ///< A step that was refused.

    /// An accepted step, @p seconds of wall-clock time after the run began or was resumed. A warning, once: after every hundred steps by
    /// error they are looked at, and told if, as long as the last fifth of them, steps to the end would be more than 10,000 and if they no
    /// longer grow. It has their number, the time they take, what holds them short, and what to try.
    std::optional<std::string> accepted(const StepRecord &record, double seconds);

  private:
    std::string text(double step, double more, double seconds, double t) const;

    const double        end_;
    std::vector<double> sizes_;                      ///< of the accepted steps since the last look [s]
    double              errors_ = 0;                 ///< sum of their errors, in tolerances
    std::size_t refused_ = 0, failed_ = 0, all_ = 0; ///< since the last look: errors too large, solves that failed; attempts of the run
    bool        told_ = false;
  };
} // namespace myolines
