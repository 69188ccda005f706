// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/compare/compare.h>
#include <myolines/output/checkpoint.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/text_file.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace myolines
{
  namespace
  {
    using Pairs = std::vector<std::pair<StateOnDisk, StateOnDisk>>;

    bool same_time(const double one, const double other)
    {
      return std::abs(one - other) <= 1e-9 * std::max(std::abs(one), std::abs(other));
    }

    std::string times_of(const Pairs &pairs)
    {
      std::string text;
      for (const auto &[first, second] : pairs)
        text += (text.empty() ? "" : ", ") + exact_text(second.t);
      return text.empty() ? "they have no time in common" : "both have " + text + " s";
    }

    [[noreturn]] void refuse(const CompareOptions &options, const std::string &what, const std::string &expected, const std::string &hint)
    {
      throw InputError(InputProblem{options.first.string() + " and " + options.second.string(), what, expected, hint});
    }

    const char *keep_more = "\"output/checkpoint/keep/every\" keeps states on the way, --set \"time/end=...\" with --resume extends a run";

    Pairs wanted(const CompareOptions &options)
    {
      const std::vector<StateOnDisk> first = states_on_disk(options.first), second = states_on_disk(options.second);
      const Pairs                    common = common_states(first, second);
      if (options.all)
        {
          if (common.empty())
            refuse(options, "the runs have no states at equal times", "at least one", keep_more);
          return common;
        }
      if (options.at)
        {
          for (const auto &pair : common)
            if (same_time(pair.second.t, *options.at))
              return {pair};
          refuse(options, "the runs have no states at t = " + exact_text(*options.at) + " s", times_of(common), keep_more);
        }
      if (!same_time(first.back().t, second.back().t))
        refuse(options, "the runs end at different times, " + exact_text(first.back().t) + " s and " + exact_text(second.back().t) + " s",
               "equal ends, or a time with --at: " + times_of(common), keep_more);
      return {{first.back(), second.back()}};
    }

    /// The table of one instant, to five digits; the file has all.
    std::string table(const double t, const std::vector<FieldDifference> &fields)
    {
      std::ostringstream out;
      out << "t = " << exact_text(t) << " s\n  " << std::left << std::setw(12) << "field" << std::right << std::setw(13) << "|first|"
          << std::setw(13) << "|second|" << std::setw(14) << "|difference|" << std::setw(13) << "relative"
          << "\n"
          << std::scientific << std::setprecision(4);
      for (const FieldDifference &field : fields)
        {
          out << "  " << std::left << std::setw(12) << field.field << std::right << std::setw(13) << field.first << std::setw(13)
              << field.second << std::setw(14) << field.difference << std::setw(13);
          if (const std::optional<double> relative = field.relative())
            out << *relative;
          else
            out << "-";
          out << "  " << field.unit << "\n";
        }
      return out.str();
    }

    std::vector<std::string> row(const double t, const FieldDifference &field)
    {
      const std::optional<double> relative = field.relative();
      return {exact_text(t),
              field.field,
              field.unit,
              exact_text(field.first),
              exact_text(field.second),
              exact_text(field.difference),
              relative ? exact_text(*relative) : ""};
    }
  } // namespace

  std::vector<StateOnDisk> states_on_disk(const std::filesystem::path &folder)
  {
    std::vector<StateOnDisk> states;
    for (const std::filesystem::path &file : kept_state_files(folder))
      states.push_back({file, CheckpointReader(file).contents().state.t});
    const double end = CheckpointReader(checkpoint_file(folder)).contents().state.t;
    while (!states.empty() && (states.back().t > end || same_time(states.back().t, end)))
      states.pop_back(); // the checkpoint is that state too
    states.push_back({checkpoint_file(folder), end});
    return states;
  }

  std::vector<std::pair<StateOnDisk, StateOnDisk>> common_states(const std::vector<StateOnDisk> &first,
                                                                 const std::vector<StateOnDisk> &second)
  {
    Pairs pairs;
    for (const StateOnDisk &one : first)
      for (const StateOnDisk &other : second)
        if (same_time(one.t, other.t))
          pairs.push_back({one, other});
    return pairs;
  }

  void compare_command(const CompareOptions &options, std::ostream &out)
  {
    std::optional<CsvFile> csv;
    const Pairs            pairs = wanted(options);
    if (!options.csv.empty())
      on_writing_rank("--csv " + options.csv.string(), "a file that can be written", "choose another one", [&] {
        csv.emplace(OutputFolder(options.csv.parent_path()), options.csv.filename().string(),
                    std::vector<std::string>{"Time [s]", "field", "unit of norms", "norm of first", "norm of second", "norm of difference",
                                             "relative difference"});
      });
    out << "first: " << options.first.string() << "\nsecond: " << options.second.string() << "\n";
    for (const auto &[first, second] : pairs)
      {
        const std::vector<FieldDifference> fields = l2_differences(SavedState(first.file), SavedState(second.file));
        out << table(second.t, fields);
        if (csv)
          for (const FieldDifference &field : fields)
            csv->row(row(second.t, field));
      }
    if (csv)
      csv->close();
    out << "L2 norms over the reference body; relative: over the norm of the second.\n";
  }
} // namespace myolines
