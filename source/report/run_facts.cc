// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_facts.h"

#include <myolines/base/counted.h>
#include <myolines/base/names.h>
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

    /// Lengths of the vectors whose first components are in the column "... x [N]".
    study::Series sizes_of(const CsvTable &table, const std::string &header_of_x)
    {
      study::Series sizes = study::series_of(table, header_of_x);
      const auto    place = header_of_x.size() - std::string("x [N]").size();
      for (const char axis : {'y', 'z'})
        {
          std::string header = header_of_x;
          header[place]      = axis;
          if (!table.column(header))
            return {};
          const study::Series component = study::series_of(table, header);
          for (std::size_t i = 0; i < sizes.x.size(); ++i)
            sizes.x[i] = std::hypot(sizes.x[i], component.x[i]);
        }
      return sizes;
    }

    bool ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
    }

    /// "force of moving end, along the line of action": 31.2 N at the end, largest 40.1 N at t = 0.2 s.
    void add_force(const std::string &name, const study::Series &series, RunFacts &facts)
    {
      const Extreme extreme = largest(series);
      if (!extreme.found)
        return;
      const std::string last = number_text(series.x.back());
      facts.glance.push_back({"force of " + name, (last.empty() ? "" : last + " N at the end; ") + "largest " + number_text(extreme.x) +
                                                      " N, at t = " + number_text(extreme.t) + " s"});
    }

    /// Along the line of action or, where there is none, the size of each force. Returns the first column with a force, "" for none.
    std::string add_forces(const std::filesystem::path &folder, RunFacts &facts)
    {
      const auto table = scene::read_csv(folder / "reaction.csv");
      if (!table || table->rows.empty())
        return "";
      const std::string along = " along the line [N]", x = " x [N]";
      std::string       first;
      for (const std::string &header : table->header)
        if (ends_with(header, along))
          {
            first = first.empty() ? header : first;
            add_force(header.substr(0, header.size() - along.size()) + ", along the line of action", study::series_of(*table, header),
                      facts);
          }
      if (!first.empty())
        facts.glance.push_back({"sign of these forces", "positive along the line of action, which points to the end that moves"});
      else
        for (const std::string &header : table->header)
          if (ends_with(header, x))
            {
              first = first.empty() ? header : first;
              add_force(header.substr(0, header.size() - x.size()) + ", its size", sizes_of(*table, header), facts);
            }
      return first;
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
    for (const auto &[words, text] : {std::pair{"system", texts[0]}, {"integrator", texts[1]}, {"steps are chosen by", texts[2]}})
      if (text)
        facts.glance.push_back({words, *text});
    const auto &start = texts[3], &end = texts[4];
    if (end)
      facts.glance.push_back({"time", start.value_or("0") + " s to " + *end + " s"});
    const std::string reason = manifest.is_object() ? manifest.value("exit reason", "") : "";
    facts.glance.push_back({"end of the run", reason.empty() ? "not known" : reason});
    if (reason != "done")
      facts.verdicts.push_back("The run did not reach its end: " + (reason.empty() ? "there is no manifest" : reason) + ".");
    const std::string force = add_forces(folder, facts);
    add_change(folder / "activation_muscle_length-3d.csv", "Muscle length [m]", "length of the muscle", " mm", 1e3, facts);
    add_change(folder / "mean_stretch_pennation_data-3d.csv", "Mean stretch", "stretch of the fibres, mean over the middle", "", 1, facts);
    add_change(folder / "mean_stretch_pennation_data-3d.csv", "Mean pennation [deg]", "pennation, mean over the middle", " degrees", 1,
               facts);
    add_steps(folder, facts);
    add_energy(manifest.is_object() ? manifest : Json::object(), facts);
    if (!facts.rejected.empty())
      facts.verdicts.push_back(counted(facts.rejected.size(), "step") + " had to be taken again; the table of rejected steps tells why.");
    const std::string file = manifest.is_object() && manifest.contains("scene") && manifest["scene"].is_string()
                                 ? manifest["scene"].get<std::string>()
                                 : "SCENE";
    facts.verdicts.push_back(
        "Errors of steps and mesh cannot be seen in one run. This command estimates them: " +
        shell_text({"myolines", "verify", file, "--quantity", force.empty() ? "FILE:COLUMN" : "reaction.csv:" + force}));
    return facts;
  }
} // namespace myolines::report
