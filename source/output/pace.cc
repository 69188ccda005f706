// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/pace.h>
#include <myolines/output/status.h>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace myolines
{
  namespace
  {
    constexpr std::size_t steps_between_looks = 100, last_steps = 20;
    constexpr double      many = 1e4, growing = 1.5;
    constexpr double      small_part = 0.05; ///< of the tolerance: an error that does not hold steps short

    double mean(const std::vector<double> &sizes, const std::size_t first, const std::size_t count)
    {
      return std::accumulate(sizes.begin() + first, sizes.begin() + first + count, 0.) / count;
    }
  } // namespace

  void Pace::rejected(const StepRecord &record)
  {
    ++all_;
    ++(record.report.outcome == StepReport::Outcome::error_too_large ? refused_ : failed_);
  }

  std::optional<std::string> Pace::accepted(const StepRecord &record, const double seconds)
  {
    ++all_;
    if (told_ || !record.report.error_estimate)
      return std::nullopt;
    sizes_.push_back(record.dt);
    errors_ += *record.report.error_estimate;
    if (sizes_.size() < steps_between_looks)
      return std::nullopt;
    const double step     = mean(sizes_, steps_between_looks - last_steps, last_steps);
    const double before   = mean(sizes_, steps_between_looks - 2 * last_steps, last_steps);
    const double attempts = 1 + static_cast<double>(refused_ + failed_) / steps_between_looks, more = (end_ - record.t) / step * attempts;
    std::optional<std::string> warning;
    if (more > many && step < growing * before)
      {
        warning = text(step, more, seconds / all_ * more, record.t);
        told_   = true;
      }
    sizes_.clear();
    errors_  = 0;
    refused_ = failed_ = 0;
    return warning;
  }

  std::string Pace::text(const double step, const double more, const double seconds, const double t) const
  {
    const double       error = errors_ / steps_between_looks;
    std::ostringstream text;
    text.precision(2);
    text << "steps are " << step << " s long at t = " << t << " s: as long as they stay so the run takes about " << more << " more, or "
         << duration_text(seconds) << ". Of the last " << steps_between_looks << " ";
    if (failed_ > refused_)
      text << failed_ << " more failed to be solved: that holds them short. To try: another method, or drives that do not jump";
    else if (error > small_part || refused_ > 0)
      text << "the error was " << error << " of the tolerance on average, and " << refused_
           << " more were refused for theirs: that holds them short. Either something moves as fast as that (it jumps, or rings), or the "
              "method makes errors of its own there. To try: another method, larger tolerances in time/control, or drives that do not jump";
    else
      text << "the error was " << error
           << " of the tolerance on average, so that it is not what holds them short: equations that are hard to solve do, the stable step "
              "of an explicit method, events close together, or a maximum step. To try: another method";
    return text.str() + " (`myolines advise` finds one)";
  }
} // namespace myolines
