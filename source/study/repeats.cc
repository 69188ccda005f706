// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/text_file.h>
#include <myolines/study/results.h>

#include <algorithm>
#include <map>

namespace myolines::study
{
  namespace
  {
    struct Median
    {
      std::optional<double> value, spread;
    };

    /// Of an even number the mean of the two in the middle; spread only of several.
    Median median_of(std::vector<double> x)
    {
      if (x.empty())
        return {};
      std::sort(x.begin(), x.end());
      const double middle = (x[(x.size() - 1) / 2] + x[x.size() / 2]) / 2;
      return {middle, x.size() > 1 ? std::optional<double>(x.back() - x.front()) : std::nullopt};
    }

    using Runs = std::vector<const Row *>;

    /// Over the runs that have the number.
    template <typename Number>
    Median median_over(const Runs &runs, const Number &number)
    {
      std::vector<double> x;
      for (const Row *run : runs)
        if (const std::optional<double> one = number(*run))
          x.push_back(*one);
      return median_of(std::move(x));
    }

    /// The value of the first run, if all have the same.
    Measured common_value(const Runs &runs, const std::size_t q)
    {
      const Measured &first = runs.front()->values[q];
      for (const Row *run : runs)
        if (const Measured &other = run->values[q]; other.value != first.value)
          {
            const auto text = [](const Measured &measured) { return measured.value ? exact_text(*measured.value) : "no value"; };
            return {{}, repeats_differ + ": " + text(first) + " and " + text(other)};
          }
      return first;
    }

    void take_seconds(const Study &study, const Runs &runs, Row &row)
    {
      const Median cpu         = median_over(runs, [](const Row &run) { return run.outcome.cpu_seconds; }),
                   wall        = median_over(runs, [](const Row &run) { return std::optional<double>(run.outcome.wall_seconds); });
      row.outcome.cpu_seconds  = cpu.value;
      row.outcome.wall_seconds = wall.value.value_or(row.outcome.wall_seconds);
      row.spread               = {runs.size(), cpu.spread, wall.spread, {}};
      row.spread.values.resize(study.quantities.size());
      for (std::size_t q = 0; q < study.quantities.size(); ++q)
        if (study.quantities[q].source == Quantity::Source::seconds)
          {
            const Median seconds = median_over(runs, [q](const Row &run) { return run.values[q].value; });
            row.values[q].value  = seconds.value;
            row.spread.values[q] = seconds.spread;
          }
        else
          row.values[q] = common_value(runs, q);
    }

    /// @p all: the point, then its repeats.
    Row taken_together(const Study &study, const Runs &all)
    {
      Row  row = *all.front();
      Runs done;
      for (const Row *run : all)
        if (run->outcome.status == "done")
          done.push_back(run);
        else if (run->outcome.status != "open" && row.outcome.status == "done")
          {
            row.outcome.status = run->outcome.status;
            row.outcome.reason = run->outcome.name + ": " + run->outcome.reason;
            row.stability      = run->stability;
          }
      for (const Row *run : done)
        if (run->stability != row.stability)
          row.stability = "unknown";
      if (row.outcome.status == "done")
        take_seconds(study, done, row);
      else
        row.values.assign(study.quantities.size(), {});
      return row;
    }
  } // namespace

  void take_repeats_together(const Study &study, std::vector<Row> &rows)
  {
    if (study.repeats == 1)
      return;
    std::map<std::string, Runs> runs; // of each point
    for (const Row &row : rows)
      runs[row.which->role == Case::Role::repeat ? row.which->repeated : row.which->name].push_back(&row);
    std::vector<Row> together;
    for (const Row &row : rows)
      if (row.which->role != Case::Role::repeat)
        together.push_back(row.which->role == Case::Role::point ? taken_together(study, runs.at(row.which->name)) : row);
    rows = std::move(together);
  }
} // namespace myolines::study
