// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/scene/columns.h>
#include <myolines/scene/csv.h>
#include <myolines/system/samples.h>

namespace myolines
{
  namespace
  {
    std::size_t time_column(const scene::CsvTable &table, const std::string &name)
    {
      if (!name.empty())
        return table.required_column(name);
      for (const char *usual : {"time", "t"})
        if (!scene::matching_columns(usual, table.header).empty())
          return table.required_column(usual);
      throw InputError(InputProblem{
          table.file.string(), "there is no column \"time\" or \"t\", such as \"Time [s]\"", "one of " + join(table.header),
          table.header.size() > 1
              ? "\"time column\" names it"
              : "commas, semicolons or tabs separate columns; the header of a file of OpenSim ends with a line \"endheader\""});
    }

    std::size_t value_column(const scene::CsvTable &table, const std::string &name, const std::size_t time)
    {
      if (!name.empty())
        return table.required_column(name);
      if (table.header.size() == 2)
        return 1 - time;
      throw InputError(InputProblem{table.file.string(),
                                    "there are " + std::to_string(table.header.size()) + " columns: " + join(table.header),
                                    "the name of one of them in \"column\"", ""});
    }

    /// The numbers of column @p i in @p unit; they are in @p given where their name has none.
    std::vector<double> numbers_in(const scene::CsvTable &table, const std::size_t i, const std::string &unit, const std::string &given)
    {
      const std::string own = scene::split_column_name(table.header[i]).unit;
      if (!own.empty() && !given.empty() && own != given)
        throw InputError(InputProblem{table.file.string(),
                                      "the column \"" + table.header[i] + "\" has the unit \"" + given + "\" in the scene",
                                      "the same, or none in the scene", ""});
      const bool                  radians = unit == "degree" && table.in_degrees == false; // the header of a file of OpenSim says so
      const std::string           from    = !own.empty() ? own : given.empty() && radians ? "rad" : given;
      const std::optional<double> factor  = unit.empty() || from.empty() ? std::optional<double>(1) : scene::unit_factor(from, unit);
      if (!factor)
        throw InputError(InputProblem{table.file.string(), "the column \"" + table.header[i] + "\" is in \"" + from + "\"",
                                      unit == "-" ? "numbers without a unit, \"-\", or \"%\"" : "a unit that can be converted to " + unit,
                                      unit == "-" ? "\"normalise\" divides by a number in this unit, or by the greatest value" : ""});
      std::vector<double> x = table.numbers(i);
      for (double &value : x)
        value *= *factor;
      return x;
    }
  } // namespace

  Samples read_samples(const SampleColumn &column, const std::string &unit)
  {
    const scene::CsvTable table = scene::read_csv_input(column.file);
    const std::size_t     time  = time_column(table, column.time);
    const Samples samples{numbers_in(table, time, "s", ""), numbers_in(table, value_column(table, column.value, time), unit, column.unit)};
    for (std::size_t row = 1; row < samples.t.size(); ++row)
      if (!(samples.t[row] > samples.t[row - 1]))
        throw InputError(InputProblem{table.where(row), "the time does not come after that of the line before", "times that ascend", ""});
    if (samples.t.size() < 2)
      throw InputError(InputProblem{column.file.string(), "holds fewer than two samples", "at least two", ""});
    return samples;
  }
} // namespace myolines
