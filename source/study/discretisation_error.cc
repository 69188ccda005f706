// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/study/discretisation_error.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace myolines::study
{
  namespace
  {
    constexpr double indistinct = 1e-14;             // of the values
    constexpr double trusted = 1.25, distrusted = 3; // factors of safety
    constexpr double lowest_rate = 0.5, cautious_rate = 1;

    /// log |d_12 / d_23| / log(r), d the differences of neighbours; none if they do not shrink.
    std::optional<double> shrinking_rate(const double before, const double after, const double ratio)
    {
      if (!(std::abs(after) < std::abs(before)))
        return std::nullopt;
      return std::log(std::abs(before / after)) / std::log(ratio);
    }

    double range(const std::vector<Sample> &samples)
    {
      const auto [least, largest] =
          std::minmax_element(samples.begin(), samples.end(), [](const Sample &a, const Sample &b) { return a.value < b.value; });
      return largest->value - least->value;
    }
  } // namespace

  DiscretisationError discretisation_error(const std::vector<Sample> &samples, const std::size_t which, const double order)
  {
    if (samples.size() < 2 || samples.size() > 3 || which >= samples.size())
      throw std::logic_error("an error is estimated from two or three values");
    DiscretisationError found;
    const Sample       &finest = samples.back(), &next = samples[samples.size() - 2];
    if (range(samples) <= indistinct * std::abs(finest.value))
      {
        found.approach = Approach::at_once;
        return found;
      }
    found.safety   = distrusted;
    found.approach = Approach::unseen;
    found.assumed  = std::min(order, cautious_rate);
    if (samples.size() == 3)
      {
        const double before = samples[0].value - next.value, after = next.value - finest.value;
        const auto   rate = shrinking_rate(before, after, next.size / finest.size);
        if (!rate)
          return {distrusted * range(samples), Approach::irregular, {}, {}, distrusted, range(samples)};
        found.approach = before * after < 0                      ? Approach::alternating
                         : std::abs(*rate - order) <= order / 10 ? Approach::as_in_theory
                                                                 : Approach::at_another_rate;
        if (found.approach != Approach::alternating)
          found.rate = rate;
        found.assumed = std::min(std::max(*rate, lowest_rate), found.rate ? order : *found.assumed);
        if (found.approach == Approach::as_in_theory)
          {
            found.assumed = order;
            found.safety  = trusted;
          }
      }
    const double known = std::abs(samples[which].value - finest.value);
    const double left  = std::abs(next.value - finest.value) / (std::pow(next.size / finest.size, *found.assumed) - 1);
    found.error        = known + found.safety * left;
    found.likely       = known + left;
    return found;
  }
} // namespace myolines::study
