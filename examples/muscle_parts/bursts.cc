// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/instants.h>
#include <myolines/system/profiles.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace myolines
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /// A sin^2(pi s / T) where s, the time since the last begin, is at most T; else 0. One begins at t0, the next after each period.
    class Bursts : public Drive
    {
    public:
      Bursts(const double amplitude, const double start, const double duration, const double period)
        : amplitude_(amplitude)
        , start_(start)
        , duration_(duration)
        , period_(period)
      {}

      double value(const double t, const Side side) const override
      {
        const auto s = since_begin(t, side);
        return s ? amplitude_ / 2 * (1 - std::cos(omega() * *s)) : 0;
      }

      double first_derivative(const double t, const Side side) const override
      {
        const auto s = since_begin(t, side);
        return s ? amplitude_ / 2 * omega() * std::sin(omega() * *s) : 0;
      }

      double second_derivative(const double t, const Side side) const override
      {
        const auto s = since_begin(t, side);
        return s ? amplitude_ / 2 * omega() * omega() * std::cos(omega() * *s) : 0;
      }

      /// The second derivative jumps where a burst begins and where it ends, but for an end that is the next begin.
      std::vector<double> kinks(const double t0, const double t1) const override
      {
        std::vector<double> times;
        const auto          add = [&](const double t) {
          if (amplitude_ != 0 && t0 < t && t < t1)
            times.push_back(t);
        };
        if (duration_ == period_)
          {
            add(start_);
            return times;
          }
        for (double n = std::max(0., std::floor((t0 - start_) / period_)); begin(n) < t1; ++n)
          {
            add(begin(n));
            add(end(n));
          }
        return times;
      }

      bool identically_zero() const override { return amplitude_ == 0; }

    private:
      double omega() const { return 2 * pi / duration_; }
      double begin(const double n) const { return start_ + n * period_; }
      double end(const double n) const { return begin(n) + duration_; }

      /// Of the burst that there is at @p t, if there is one; at a kink the side decides.
      std::optional<double> since_begin(const double t, const Side side) const
      {
        const double tolerance = time_tolerance(t);
        const double n         = std::max(0., std::round((t - start_) / period_)); // this one, or the one before
        const double last      = has_begun(begin(n), t, side, tolerance) ? n : n - 1;
        if (last < 0 || (duration_ < period_ && has_begun(end(last), t, side, tolerance)))
          return std::nullopt;
        return t - begin(last);
      }

      const double amplitude_, start_, duration_, period_; ///< A, t0, T, P [s]
    };

    scene::Schema bursts_schema(const std::string &quantity, const std::string &unit)
    {
      using scene::Range;
      scene::Schema schema("Bursts A sin^2(pi s/T) of a duration T, s the time since the begin of each, the first at t0.");
      schema.number("amplitude", std::nullopt, unit, Range::any(), "Greatest value A of the " + quantity + ".")
          .number("start", 0, "s", Range::any(), "Time t0 at which the first begins.")
          .number("duration", std::nullopt, "s", Range::positive(), "T.")
          .optional_number("period", "s", Range::positive(), "Time from one begin to the next, at least T; absent: T.");
      return schema;
    }

    std::unique_ptr<Drive> make_bursts(const scene::Node &node, const Driven &)
    {
      const double duration = node.number("duration");
      const double period   = node.has("period") ? node.number("period") : duration;
      if (period < duration)
        node.refuse("period", "a burst begins before the one before is over", "at least the \"duration\"");
      return std::make_unique<Bursts>(node.number("amplitude"), node.number("start"), duration, period);
    }
  } // namespace

  ProfileEntry bursts_entry()
  {
    return {"bursts", {"amplitude=0.8", "start=0.1", "duration=0.2", "period=0.35"}, bursts_schema, make_bursts};
  }
} // namespace myolines
