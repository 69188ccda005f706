// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/study/measures.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace myolines::study
{
  namespace
  {
    using Values = std::vector<double>;

    constexpr double rounding = 1e-12; // relative, of times that should agree

    double largest(const Values &x)
    {
      double size = 0;
      for (const double value : x)
        size = std::max(size, std::abs(value));
      return size;
    }

    double total_variation(const Values &x)
    {
      double sum = 0;
      for (std::size_t i = 1; i < x.size(); ++i)
        sum += std::abs(x[i] - x[i - 1]);
      return sum;
    }

    Measured ratio(const double numerator, const double denominator, const std::string &of_nothing)
    {
      if (denominator > 0)
        return {numerator / denominator, ""};
      return {{}, of_nothing};
    }

    Measured growth(const Series &series)
    {
      const double quarter = (series.t.back() - series.t.front()) / 4;
      const Values first = window(series, {}, series.t.front() + quarter).x, last = window(series, series.t.back() - quarter, {}).x;
      return ratio(largest(last), largest(first), "the column is zero in the first quarter");
    }

    double decay_time(const Series &series, const double fraction)
    {
      std::size_t peak = 0, last = 0;
      const auto  deviation = [&series](const std::size_t i) { return std::abs(series.x[i] - series.x.back()); };
      for (std::size_t i = 0; i < series.x.size(); ++i)
        if (deviation(i) > deviation(peak))
          peak = i;
      for (std::size_t i = 0; i < series.x.size(); ++i)
        if (deviation(i) > fraction * deviation(peak))
          last = i;
      return series.t[std::max(last, peak)] - series.t[peak];
    }

    Values difference(const Values &x, const Values &r)
    {
      Values e(x.size());
      for (std::size_t i = 0; i < x.size(); ++i)
        e[i] = x[i] - r[i];
      return e;
    }

    double root_mean_square(const Values &t, const Values &e)
    {
      double integral = 0;
      for (std::size_t i = 1; i < t.size(); ++i)
        integral += (t[i] - t[i - 1]) * (e[i] * e[i] + e[i - 1] * e[i - 1]) / 2;
      const double length = t.back() - t.front();
      return length > 0 ? std::sqrt(integral / length) : std::abs(e.front());
    }

    Measured overshoot(const Values &x, const Values &r)
    {
      const auto   range  = std::minmax_element(r.begin(), r.end());
      const auto   reach  = std::minmax_element(x.begin(), x.end());
      const double beyond = std::max({*reach.second - *range.second, *range.first - *reach.first, 0.});
      return ratio(beyond, *range.second - *range.first, "the reference is constant");
    }

    struct Known
    {
      std::string                                                                      name;
      bool                                                                             compares, is_error;
      std::function<Measured(const Series &, const Values &r, const MeasureOptions &)> measure;
    };

    const std::vector<Known> &known_measures()
    {
      using Options = MeasureOptions;
      static const std::vector<Known> all{
          {"final", false, false,
           [](const Series &s, const Values &, const Options &) {
             return Measured{s.x.back(), ""};
           }},
          {"minimum", false, false,
           [](const Series &s, const Values &, const Options &) {
             return Measured{*std::min_element(s.x.begin(), s.x.end()), ""};
           }},
          {"maximum", false, false,
           [](const Series &s, const Values &, const Options &) {
             return Measured{*std::max_element(s.x.begin(), s.x.end()), ""};
           }},
          {"total variation", false, false,
           [](const Series &s, const Values &, const Options &) {
             return Measured{total_variation(s.x), ""};
           }},
          {"growth", false, false, [](const Series &s, const Values &, const Options &) { return growth(s); }},
          {"decay time", false, false,
           [](const Series &s, const Values &, const Options &o) {
             return Measured{decay_time(s, o.fraction), ""};
           }},
          {"final error", true, true,
           [](const Series &s, const Values &r, const Options &) {
             return Measured{std::abs(s.x.back() - r.back()), ""};
           }},
          {"maximum error", true, true,
           [](const Series &s, const Values &r, const Options &) {
             return Measured{largest(difference(s.x, r)), ""};
           }},
          {"root mean square error", true, true,
           [](const Series &s, const Values &r, const Options &) {
             return Measured{root_mean_square(s.t, difference(s.x, r)), ""};
           }},
          {"overshoot", true, false, [](const Series &s, const Values &r, const Options &) { return overshoot(s.x, r); }},
          {"late overshoot", true, false,
           [](const Series &s, const Values &r, const Options &) {
             return overshoot(window(s, s.t.back() - (s.t.back() - s.t.front()) / 4, {}).x, r);
           }},
          {"relative variation", true, false, [](const Series &s, const Values &r, const Options &) {
             return ratio(total_variation(s.x), total_variation(r), "the reference is constant");
           }}};
      return all;
    }
  } // namespace

  std::vector<std::string> measure_names()
  {
    std::vector<std::string> names;
    for (const Known &known : known_measures())
      names.push_back(known.name);
    return names;
  }

  std::vector<std::string> measure_names_with_reference()
  {
    std::vector<std::string> names;
    for (const Known &known : known_measures())
      if (known.compares)
        names.push_back(known.name);
    return names;
  }

  bool is_ratio(const std::string &measure)
  {
    for (const char *name : {"growth", "overshoot", "late overshoot", "relative variation"})
      if (measure == name)
        return true;
    return false;
  }

  Measured measure(const std::string &name, const Series &series, const std::vector<double> *reference, const MeasureOptions &options)
  {
    const auto &all   = known_measures();
    const auto  known = std::find_if(all.begin(), all.end(), [&name](const Known &k) { return k.name == name; });
    if (known == all.end() || (known->compares && reference == nullptr))
      throw std::logic_error("no measure \"" + name + "\", or one without its reference");
    if (series.x.empty())
      return {{}, "there is no row"};
    if (!std::all_of(series.x.begin(), series.x.end(), [](const double x) { return std::isfinite(x); }))
      return {{}, not_finite};
    static const Values none;
    const Values       &r        = reference == nullptr ? none : *reference;
    const Measured      measured = known->measure(series, r, options);
    return options.relative && known->is_error && measured.value ? ratio(*measured.value, largest(r), "the reference is zero") : measured;
  }

  Series window(const Series &series, const std::optional<double> from, const std::optional<double> until)
  {
    Series inside;
    for (std::size_t i = 0; i < series.t.size(); ++i)
      if ((!from || series.t[i] >= *from - rounding * std::abs(*from)) && (!until || series.t[i] <= *until + rounding * std::abs(*until)))
        {
          inside.t.push_back(series.t[i]);
          inside.x.push_back(series.x[i]);
        }
    return inside;
  }

  std::optional<std::vector<double>> reference_at(const Series &reference, const std::vector<double> &t)
  {
    const Values &times = reference.t;
    if (t.empty())
      return Values{};
    if (times.empty())
      return std::nullopt;
    const double tolerance = rounding * std::max(std::abs(times.back()), std::abs(times.front()));
    if (t.front() < times.front() - tolerance || t.back() > times.back() + tolerance)
      return std::nullopt;
    Values values;
    for (const double instant : t)
      {
        const auto        after = std::lower_bound(times.begin(), times.end(), instant - tolerance);
        const std::size_t i     = std::min<std::size_t>(after - times.begin(), times.size() - 1);
        if (i == 0 || std::abs(times[i] - instant) <= tolerance)
          values.push_back(reference.x[i]);
        else
          {
            const double s = (instant - times[i - 1]) / (times[i] - times[i - 1]);
            values.push_back((1 - s) * reference.x[i - 1] + s * reference.x[i]);
          }
      }
    return values;
  }
} // namespace myolines::study
