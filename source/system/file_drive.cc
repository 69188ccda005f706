// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/numbers.h>
#include <myolines/system/file_drive.h>
#include <myolines/system/zajac.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace myolines
{
  namespace
  {
    using scene::format_number;
    using scene::Node;
    using scene::Range;
    using scene::Schema;

    bool is_bounded(const Range &range) { return std::isfinite(range.low) && std::isfinite(range.high); }

    void rectify(std::vector<double> &x)
    {
      const double mean = std::accumulate(x.begin(), x.end(), 0.) / static_cast<double>(x.size());
      for (double &value : x)
        value = std::abs(value - mean);
    }

    /// What values are divided by and multiplied with, in one.
    double factor_of(const std::vector<double> &x, const FileProfile &profile)
    {
      const double maximum = profile.by_own_maximum ? *std::max_element(x.begin(), x.end()) : profile.maximum.value_or(1);
      if (!(maximum > 0))
        throw InputError(InputProblem{profile.where,
                                      "the greatest value of the samples is " + format_number(maximum) + ": nothing can be divided by it",
                                      "a maximum above zero", "\"rectify\" = \"true\" for raw EMG"});
      return profile.scale / maximum;
    }

    struct Extent
    {
      double least, greatest;
    };

    Extent extent_of(const std::vector<double> &x)
    {
      const auto [least, greatest] = std::minmax_element(x.begin(), x.end());
      return {*least, *greatest};
    }

    /// How values outside the range may be meant.
    std::string hint_for(const std::vector<double> &x, const Range &range, const FileProfile &profile)
    {
      const Extent extent = extent_of(x);
      if (extent.least < range.low && !profile.rectify)
        return "raw EMG? Then \"rectify\", \"low-pass\" and \"normalise\" make an envelope of it";
      if (extent.greatest <= 100 * range.high && profile.column.unit.empty())
        return "percent? Then write the unit into the name of the column, \"name [%]\"";
      return "\"normalise\" divides by a maximum";
    }

    void keep_in_range(const Samples &samples, std::vector<double> &x, const FileProfile &profile, const Driven &driven)
    {
      const Range &range     = driven.range;
      const double tolerance = 1e-6 * (range.high - range.low);
      for (std::size_t i = 0; i < x.size(); ++i)
        if (!(x[i] >= range.low - tolerance && x[i] <= range.high + tolerance))
          throw InputError(InputProblem{profile.where,
                                        "the " + driven.quantity + " in " + profile.column.file.string() + " is " + format_number(x[i]) +
                                            " at t = " + format_number(samples.t[i]) + " s",
                                        "numbers from " + format_number(range.low) + " to " + format_number(range.high),
                                        hint_for(x, range, profile)});
      for (double &value : x)
        value = std::clamp(value, range.low, range.high);
    }

    SampledDrive between(const Samples &samples, const FileProfile &profile, const Driven &driven)
    {
      if (profile.lines)
        return SampledDrive::lines(samples.t, samples.x);
      SampledDrive spline          = SampledDrive::spline(samples.t, samples.x);
      const auto [least, greatest] = spline.extremes();
      const bool leaves            = least < driven.range.low || greatest > driven.range.high;
      return is_bounded(driven.range) && leaves ? SampledDrive::monotone(samples.t, samples.x) : spline;
    }

    std::string interval_text(const double begin, const double end)
    {
      return "from " + format_number(begin) + " s to " + format_number(end) + " s";
    }
  } // namespace

  struct FileDrive::Made
  {
    Made(const FileProfile &profile, const Driven &driven)
      : samples(read_samples(profile.column, profile.by_own_maximum || profile.maximum ? "" : driven.unit))
    {
      for (double &t : samples.t)
        t += profile.shift;
      if (profile.rectify)
        rectify(samples.x);
      if (profile.low_pass && profile.lines)
        throw InputError(InputProblem{profile.where, "straight lines do not smooth", "smooth interpolation, or no cut-off frequency", ""});
      const double overshoot = profile.low_pass ? low_pass(*profile.low_pass, is_bounded(driven.range)) : 0;
      const double factor    = factor_of(samples.x, profile);
      for (double &value : samples.x)
        value *= factor;
      if (!is_bounded(driven.range))
        return;
      keep_in_range(samples, samples.x, profile, driven);
      if (const double cut = overshoot * std::abs(factor); cut > 1e-3 * (driven.range.high - driven.range.low))
        note = "the low-pass filter overshoots the samples of the " + driven.quantity + " in " + profile.column.file.string() +
               " by up to " + format_number(std::round(1e4 * cut) / 1e4) + ": that is cut off at their least and greatest value";
    }

    /// Returns by how much filtered values are less or greater than all samples, which is cut off if they are @p bounded.
    double low_pass(const double cut_off, const bool bounded)
    {
      const Extent allowed = extent_of(samples.x);
      samples.x            = spline_filtered(samples.t, samples.x, cut_off);
      const Extent found   = extent_of(samples.x);
      if (bounded)
        for (double &value : samples.x)
          value = std::clamp(value, allowed.least, allowed.greatest);
      return std::max(allowed.least - found.least, found.greatest - allowed.greatest);
    }

    Samples     samples;
    std::string note;
  };

  FileDrive::FileDrive(const FileProfile &profile, const Driven &driven)
    : FileDrive(profile, driven, Made(profile, driven))
  {}

  FileDrive::FileDrive(const FileProfile &profile, const Driven &driven, const Made &made)
    : SampledDrive(between(made.samples, profile, driven))
    , where_(profile.where)
    , file_(profile.column.file.string())
    , note_(made.note)
  {}

  void FileDrive::require(const double start, const double end) const
  {
    const double rounding = 1e-9 * std::max({std::abs(start), std::abs(end), this->end() - begin()});
    if (start < begin() - rounding || end > this->end() + rounding)
      throw InputError(InputProblem{where_, "the samples in " + file_ + " are known " + interval_text(begin(), this->end()),
                                    "samples " + interval_text(start, end) + ", as \"time/start\" and \"time/end\" say",
                                    "choose a start and an end inside the samples, or move their times by \"shift\""});
  }

  std::string FileDrive::note_of_times(const double start, const double end) const
  {
    constexpr std::size_t few = 10, many = 20;
    const std::size_t     n = n_samples(start, end), all = n_samples();
    const bool            hardly_any = n <= 1 && all >= few; // the run is shorter than the time between two of them
    if (!hardly_any && (n >= few || all < many * (n + 1)))
      return "";
    return "only " + std::to_string(n) + " of the " + std::to_string(all) + " samples in " + file_ +
           " are within the run: they are known " + interval_text(begin(), this->end()) +
           ". If their times are in milliseconds, write that into the name of their column, such as \"time [ms]\"";
  }

  const FileDrive *file_of(const Drive *drive)
  {
    if (const auto *activation = dynamic_cast<const ZajacActivation *>(drive))
      return file_of(&activation->excitation());
    return dynamic_cast<const FileDrive *>(drive);
  }

  scene::Schema file_profile_schema(const std::string &unit)
  {
    Schema schema("Samples in a file: comma, semicolon or tab separated under a line of names, or .sto and .mot of OpenSim (doc/data.md).");
    schema.file("file", "The file.")
        .optional_text("column", "Name of the column of values; not needed where there is one beside the times, for example \"EMG [mV]\".")
        .optional_text("time column", "Name of the column of times; absent: \"time\" or \"t\".")
        .optional_text("unit", "Unit of the values where the name of the column has none, for example \"mV\"; absent: [" + unit + "].")
        .number("shift", 0, "s", Range::any(), "Is added to the times.")
        .boolean("rectify", false, "x becomes |x - mean of x|, before all that follows.")
        .optional_number("low-pass", "Hz", Range::positive(), "Cut-off frequency, at which half passes, without a shift in time.")
        .optional_text("normalise", "What values are divided by: \"maximum\" (of the file), or a number in the unit of the file.")
        .number("scale", 1, "-", Range::any(), "Multiplies the values.")
        .choice("interpolation", "smooth", {"smooth", "lines"}, "Lines: every sample is a kink.");
    return schema;
  }

  std::unique_ptr<FileDrive> make_file_drive(const Node &node, const Driven &driven)
  {
    const auto  text = [&](const std::string &name) { return node.has(name) ? node.text(name) : std::string(); };
    FileProfile profile{node.where("file"), {node.file("file"), text("time column"), text("column"), text("unit")}};
    profile.shift   = node.number("shift");
    profile.rectify = node.boolean("rectify");
    if (node.has("low-pass"))
      profile.low_pass = node.number("low-pass");
    profile.by_own_maximum = text("normalise") == "maximum";
    if (node.has("normalise") && !profile.by_own_maximum)
      {
        profile.maximum = scene::parse_number(node.text("normalise"));
        if (!profile.maximum || *profile.maximum <= 0)
          node.refuse("normalise", "\"" + node.text("normalise") + "\" is no maximum", "\"maximum\", or a number above zero");
      }
    profile.scale = node.number("scale");
    profile.lines = node.text("interpolation") == "lines";
    return std::make_unique<FileDrive>(profile, driven);
  }
} // namespace myolines
