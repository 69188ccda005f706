// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_facts.h"

#include <myolines/scene/csv.h>
#include <myolines/scene/numbers.h>
#include <myolines/scene/scene.h>
#include <myolines/study/csv_table.h>

#include <cmath>

namespace myolines::report
{
  namespace
  {
    using scene::CsvTable;

    struct Extreme
    {
      double x = 0, t = 0;
      bool   found = false;
    };

    /// The value farthest from zero.
    Extreme largest(const study::Series &series)
    {
      Extreme extreme;
      for (std::size_t i = 0; i < series.x.size(); ++i)
        if (std::isfinite(series.x[i]) && (!extreme.found || std::abs(series.x[i]) > std::abs(extreme.x)))
          extreme = {series.x[i], series.t[i], true};
      return extreme;
    }

    bool ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
    }

    /// "largest force of moving end along the line": 31.2 N at t = 0.2 s.
    void add_forces(const std::filesystem::path &folder, RunFacts &facts)
    {
      const auto table = scene::read_csv(folder / "reaction.csv");
      if (!table || table->rows.empty())
        return;
      for (const std::string &header : table->header)
        if (ends_with(header, " along the line [N]") || header == "moving end x [N]")
          if (const Extreme extreme = largest(study::series_of(*table, header)); extreme.found)
            facts.glance.push_back({"largest force, " + header.substr(0, header.size() - 4),
                                    number_text(extreme.x) + " N at t = " + number_text(extreme.t) + " s"});
    }

    /// First and last value of a column.
    void add_change(const std::filesystem::path &file, const std::string &header, const std::string &words, const std::string &unit,
                    const double factor, RunFacts &facts)
    {
      const auto table = scene::read_csv(file);
      if (!table || table->rows.empty() || !table->column(header))
        return;
      const study::Series series = study::series_of(*table, header);
      if (const std::string first = number_text(factor * series.x.front()), last = number_text(factor * series.x.back());
          !first.empty() && !last.empty())
        facts.glance.push_back({words, first + unit + " at the start, " + last + unit + " at the end"});
    }

    void add_steps(const std::filesystem::path &folder, RunFacts &facts)
    {
      const auto table = scene::read_csv(folder / "steps.csv");
      if (!table)
        return;
      const auto column = [&](const char *name) { return table->column(name); };
      const auto time = column("Time [s]"), size = column("dt [s]"), outcome = column("Outcome"), newton = column("Newton iterations"),
                 linear = column("Linear iterations"), reason = column("Reason");
      if (!time || !size || !outcome || !newton || !linear || !reason)
        return;
      study::Curve sizes{"accepted", {}}, refused{"rejected", {}}, newtons{"Newton iterations", {}}, linears{"linear iterations", {}};
      double       n_newton = 0, n_linear = 0;
      for (const auto &row : table->rows)
        {
          const double t = scene::parse_number(row[*time]).value_or(NAN), dt = scene::parse_number(row[*size]).value_or(NAN);
          const double newton_of_step = scene::parse_number(row[*newton]).value_or(0),
                       linear_of_step = scene::parse_number(row[*linear]).value_or(0);
          n_newton += newton_of_step;
          n_linear += linear_of_step;
          if (row[*outcome] != "accepted")
            {
              refused.points.emplace_back(t, dt);
              facts.rejected.push_back({row[*time], row[*size], row[*outcome], row[*reason]});
              continue;
            }
          sizes.points.emplace_back(t, dt);
          newtons.points.emplace_back(t, newton_of_step);
          linears.points.emplace_back(t, linear_of_step);
        }
      facts.glance.push_back(
          {"steps", std::to_string(sizes.points.size()) + " accepted, " + std::to_string(refused.points.size()) + " rejected"});
      facts.glance.push_back(
          {"iterations", number_text(n_newton) + " of Newton's method, " + number_text(n_linear) + " of linear solvers"});
      const auto add = [&](const char *title, const char *label, std::vector<study::Curve> curves) {
        study::Picture picture;
        picture.title   = title;
        picture.x_label = "time [s]";
        picture.y_label = label;
        picture.lines   = false;
        picture.curves  = std::move(curves);
        facts.steps.push_back(picture);
      };
      add("Sizes of the steps", "dt [s]", {sizes, refused});
      add("Work of each step", "iterations", {newtons, linears});
    }

    void add_energy(const Json &manifest, RunFacts &facts)
    {
      if (!manifest.contains("energy") || !manifest["energy"].is_object())
        {
          facts.verdicts.push_back("Nobody looked at the balance of energy in this run: what the time steps lose is not known.");
          return;
        }
      const double drift = manifest["energy"].value("drift [J]", NAN), exchanged = manifest["energy"].value("exchanged [J]", NAN);
      if (!std::isfinite(drift) || !(exchanged > 0))
        return;
      const double part = std::abs(drift) / exchanged;
      facts.glance.push_back({"drift of the energy balance", number_text(drift) + " J, " + number_text(100 * part) + " % of the " +
                                                                 number_text(exchanged) + " J exchanged"});
      facts.verdicts.push_back(std::string("Time steps: the energy balance drifts by ") + number_text(100 * part) +
                               " % of the energy exchanged" +
                               (drift < 0   ? " (a loss)"
                                : drift > 0 ? " (a gain)"
                                            : "") +
                               (part < 0.01   ? ": small."
                                : part < 0.05 ? ": look whether shorter steps change the number that you are after."
                                              : ": large; shorter steps or another method will change results."));
    }
  } // namespace

  RunFacts facts_of(const std::filesystem::path &folder, const Json &manifest)
  {
    RunFacts          facts;
    const std::string resolved = (folder / "scene.resolved.xml").string();
    const auto texts = scene::peek_texts(resolved, {"system/type", "integrator/type", "time/control/type", "time/start", "time/end"});
    for (const auto &[words, text] : {std::pair{"system", texts[0]}, {"integrator", texts[1]}, {"steps chosen", texts[2]}})
      if (text)
        facts.glance.push_back({words, *text});
    const auto &start = texts[3], &end = texts[4];
    if (end)
      facts.glance.push_back({"time", start.value_or("0") + " s to " + *end + " s"});
    const std::string reason = manifest.is_object() ? manifest.value("exit reason", "") : "";
    facts.glance.push_back({"end of the run", reason.empty() ? "not known" : reason});
    if (reason != "done")
      facts.verdicts.push_back("The run did not reach its end: " + (reason.empty() ? "there is no manifest" : reason) + ".");
    add_forces(folder, facts);
    add_change(folder / "activation_muscle_length-3d.csv", "Muscle length [m]", "length of the muscle", " mm", 1e3, facts);
    add_change(folder / "mean_stretch_pennation_data-3d.csv", "Mean stretch", "stretch of the fibres, mean over the middle", "", 1, facts);
    add_change(folder / "mean_stretch_pennation_data-3d.csv", "Mean pennation [deg]", "pennation, mean over the middle", " degrees", 1,
               facts);
    add_steps(folder, facts);
    add_energy(manifest.is_object() ? manifest : Json::object(), facts);
    if (!facts.rejected.empty())
      facts.verdicts.push_back(std::to_string(facts.rejected.size()) +
                               " steps were rejected and taken again; the table of steps tells why.");
    facts.verdicts.push_back(
        "Errors of steps and mesh cannot be seen in one run. This command estimates them: myolines verify SCENE --quantity FILE:COLUMN");
    return facts;
  }
} // namespace myolines::report
