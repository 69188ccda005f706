// SPDX-License-Identifier: LGPL-2.1-or-later
#include "advise_report.h"
#include "number_text.h"
#include "runs_table.h"

#include <myolines/base/names.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/text_file.h>
#include <myolines/study/results.h>

#include <algorithm>
#include <cmath>

namespace myolines::study
{
  namespace
  {
    std::string with_unit(const std::string &number, const std::string &header)
    {
      const std::string unit = unit_in(header);
      return unit.empty() ? number : number + " " + unit;
    }

    std::string text_of_quantity(const AdviceReport &report, const std::size_t q)
    {
      const PilotRun   &known = report.advice.trial ? *report.advice.trial->run : report.reference.run();
      const NamedValue &value = known.values[q];
      const double      steps = report.advice.best_errors()[q], mesh = report.mesh.errors[q],
                   asked = report.pilot.accuracy_of(known.plain_values())[q];
      std::string text   = report.pilot.quantities()[q].file + ", " + value.header + ", " + words_of(report.pilot.quantities()[q]) + ": " +
                         with_unit(digits(asked, 2), value.header) + " are asked for";
      text += "\n  error   about " + with_unit(digits(steps + mesh, 2), value.header) + ": " + digits(steps, 2) + " of the steps";
      if (report.advice.trial)
        text += ", as tried (predicted " + digits(report.advice.errors[q], 2) + ")";
      else // measured, see doc/advise.md
        text += ", by the pilot alone (of such errors 1/15 to 30 times have been measured)";
      text += report.mesh.rung == nullptr || mesh == 0 ? "" : ", " + digits(mesh, 2) + " of the mesh";
      if (value.value != 0)
        text += "; " + digits(100 * (steps + mesh) / std::abs(value.value), 2) + " % of " + digits(value.value, 4);
      return text + "\n";
    }

    /// Cheapest first, then those that were not found.
    std::vector<const Track *> in_order(const Search &search)
    {
      std::vector<const Track *> tracks;
      for (const Track &track : search.tracks())
        tracks.push_back(&track);
      const auto key = [](const Track *track) {
        return std::make_pair(track->state != Track::State::found, track->state == Track::State::found ? Search::work_of(*track) : 0);
      };
      std::stable_sort(tracks.begin(), tracks.end(), [&key](const Track *a, const Track *b) { return key(a) < key(b); });
      return tracks;
    }

    bool has_run(const Track &track) { return !track.runs.empty() && track.runs.at(track.rung)->done(); }

    std::string outcome_of(const Track &track)
    {
      switch (track.state)
        {
        case Track::State::dearer:
          return "costs more before it is accurate";
        case Track::State::too_coarse:
          return "not accurate with the finest";
        case Track::State::failing:
          return track.runs.back()->outcome.reason.substr(0, track.runs.back()->outcome.reason.find("; expected: "));
        default:
          return "";
        }
    }

    std::string column_of(std::string text, const std::size_t width)
    {
      text.resize(std::max(text.size() + 2, width), ' ');
      return text;
    }

    std::string line_of(const AdviceReport &report, const Track &track)
    {
      std::string text = "  " + column_of(track.candidate->name, 34);
      if (!has_run(track))
        return text + outcome_of(track) + "\n";
      const PilotRun &run = *track.runs[track.rung];
      text += column_of(track.candidate->rungs[track.rung].label, 14);
      text += column_of(digits(report.reference.ratio(report.reference.errors_of(run)), 2), 12);
      text += column_of(digits(run.seconds(), 2), 12) + column_of(digits(report.search.seconds_of(track), 2), 12);
      const std::string outcome = outcome_of(track);
      return text.substr(0, text.find_last_not_of(' ') + 1) + (outcome.empty() ? "" : "  " + outcome) + "\n";
    }

    std::string refusals(const Choices &choices)
    {
      std::string text;
      for (const auto &[name, why] : choices.refused)
        text += "  " + column_of(name, 34) + why + "\n";
      return text.empty() ? text : "Not of the scene:\n" + text;
    }

    void write_candidates(const AdviceReport &report, const std::filesystem::path &folder)
    {
      std::vector<std::string> header{
          "method",  "parameter",       "value", "outcome", "advised", "error over accuracy", "CPU of the pilot [s]",
          "CPU [s]", "CPU as tried [s]"};
      for (const VerifiedQuantity &quantity : report.pilot.quantities())
        for (const char *what : {"error of steps, ", "error of steps as tried, ", "error of mesh, ", "value, "})
          header.push_back(what + quantity.text);
      CsvFile file(OutputFolder(folder), "advise.csv", header);
      for (const Track *track : in_order(report.search))
        {
          const bool               advised = track == report.advice.track;
          std::vector<std::string> cells{track->candidate->name, track->candidate->parameter, "", outcome_of(*track),
                                         advised ? "yes" : "no"};
          cells.resize(header.size());
          if (has_run(*track))
            {
              const PilotRun &run    = *track->runs[track->rung];
              const Values    errors = advised ? report.advice.errors : report.reference.errors_of(run);
              cells[2]               = track->candidate->rungs[track->rung].label;
              cells[5]               = exact_text(report.reference.ratio(errors));
              cells[6]               = exact_text(run.seconds());
              cells[7]               = exact_text(report.search.seconds_of(*track));
              const Trial *trial     = advised && report.advice.trial ? &*report.advice.trial : nullptr;
              if (trial != nullptr)
                cells[8] = exact_text(trial->run->seconds());
              for (std::size_t q = 0; q < errors.size(); ++q)
                {
                  const std::size_t first = 9 + 4 * q;
                  cells[first]            = exact_text(errors[q]);
                  cells[first + 1]        = trial != nullptr ? exact_text(trial->errors[q]) : "";
                  cells[first + 2]        = exact_text(report.mesh.errors[q]);
                  cells[first + 3]        = exact_text(run.values[q].value);
                }
            }
          file.row(cells);
        }
      file.close();
    }
  } // namespace

  std::string advice_text(const AdviceReport &report)
  {
    const Candidate &taken = *report.advice.track->candidate;
    const bool       tried = report.advice.trial.has_value();
    std::string      text  = "Advised: " + taken.name + ", " + taken.parameter + " = " + report.advice.rung->label;
    if (report.mesh.rung != nullptr)
      text += ", " + report.choices.mesh.parameter + " = " + report.mesh.rung->label;
    text += "\n  cost    about " + digits(report.advice.best_seconds(), 2) + " CPU s" +
            (tried ? ", as tried; predicted " + digits(report.advice.seconds, 2) : "") + "\n";
    for (std::size_t q = 0; q < report.pilot.quantities().size(); ++q)
      text += text_of_quantity(report, q);
    text += "Runs of the pilot";
    if (report.mesh.pilot != nullptr)
      text += ", " + report.choices.mesh.parameter + " = " + report.mesh.pilot->label;
    text += "; their errors beside " + report.reference.run().name + ", of which the mesh leaves " + digits(report.search.allowed(), 2) +
            " to the steps:\n  " + column_of("method", 34) + column_of("step [s]", 14) + column_of("error over", 12) +
            column_of("CPU s", 12) + "CPU s on the\n  " + column_of("", 34) + column_of("or tolerance", 14) + column_of("accuracy", 24) +
            "mesh advised\n";
    for (const Track *track : in_order(report.search))
      text += line_of(report, *track);
    return text + refusals(report.choices);
  }

  void write_advice_tables(const AdviceReport &report, const std::filesystem::path &folder)
  {
    write_candidates(report, folder);
    std::vector<std::string> quantities;
    for (const VerifiedQuantity &quantity : report.pilot.quantities())
      quantities.push_back(quantity.text);
    std::vector<RunRow> rows;
    for (const auto &[name, run] : report.pilot.runs())
      {
        rows.push_back({&name, &run.outcome, std::vector<std::optional<double>>(quantities.size())});
        for (std::size_t q = 0; q < run.values.size(); ++q)
          rows.back().values[q] = run.values[q].value;
      }
    write_runs_table(quantities, rows, folder);
  }
} // namespace myolines::study
