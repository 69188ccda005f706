// SPDX-License-Identifier: LGPL-2.1-or-later
#include "body_data.h"
#include "charts.h"
#include "run_facts.h"

#include <myolines/base/error.h>
#include <myolines/picture/body.h>
#include <myolines/scene/scene.h>
#include <myolines/study/plot.h>
#include <myolines/study/plot_page.h>

#include <algorithm>

namespace myolines::report
{
  namespace
  {
    constexpr std::size_t bytes_of_body = 2000000, open_charts = 8;

    std::vector<std::string> texts(const Json &manifest, const char *name)
    {
      std::vector<std::string> all;
      if (manifest.is_object() && manifest.contains(name) && manifest[name].is_array())
        for (const Json &text : manifest[name])
          if (text.is_string())
            all.push_back(text);
      return all;
    }

    /// What readers look for first.
    std::size_t rank_of(const study::Picture &picture)
    {
      std::size_t rank = 0;
      for (const char *file : {"reaction_N", "activation_muscle_length-3d", "mean_stretch_pennation_data-3d", "fascicles", "energy_balance",
                               "shape", "force_data-3d", "gearing", "trajectory", "trace", "muscle_tendon", "energy"})
        {
          if (picture.name.compare(0, std::string(file).size(), file) == 0)
            return rank;
          ++rank;
        }
      return rank;
    }

    void add_body(const std::filesystem::path &folder, Page &page, std::vector<std::string> &notes)
    {
      page.chapter("The body");
      if (!picture::RunFields::are_in(folder))
        {
          page.paragraph("The run wrote no fields, so there is no body to see. A run with --set \"output/fields/what=displacement, "
                         "stretch\" has one.");
          return;
        }
      try
        {
          BodyData body = body_data(folder, bytes_of_body);
          page.body(body.png, body.caption, std::move(body.json));
          page.table({"field", "value", "unit", "at t [s]", "x, y, z at rest [mm]"}, body.extremes, true);
          for (const std::string &note : body.notes)
            page.paragraph(note, "hint");
        }
      catch (const InputError &error)
        {
          notes.push_back(error.what());
          page.paragraph(std::string("The fields cannot be read: ") + error.what(), "note");
        }
    }

    void add_series(const std::filesystem::path &folder, Page &page)
    {
      page.chapter("Over time");
      std::vector<study::Picture> pictures;
      try
        {
          pictures = study::pictures_of_runs({folder}, "");
        }
      catch (const InputError &)
        {
          page.paragraph("The run has no time series.", "note");
          return;
        }
      const std::vector<study::Constant> constants = study::without_constants(pictures);
      std::stable_sort(pictures.begin(), pictures.end(), [](const auto &a, const auto &b) { return rank_of(a) < rank_of(b); });
      const auto all = drawn(pictures);
      for (std::size_t i = 0; i < all.size(); ++i)
        {
          if (i == open_charts)
            page.open_details("More series (" + std::to_string(all.size() - i) + ")");
          page.chart(all[i].first, all[i].second);
        }
      if (all.size() > open_charts)
        page.close_details();
      if (constants.empty())
        return;
      std::vector<Cells> rows;
      for (const study::Constant &constant : constants)
        rows.push_back({constant.title, number_text(constant.value)});
      page.open_details("What stays constant (" + std::to_string(rows.size()) + " columns)");
      page.table({"column", "value"}, rows, true);
      page.close_details();
    }

    void add_work(const std::filesystem::path &folder, const RunFacts &facts, Page &page)
    {
      page.chapter("Steps and work");
      for (const auto &[picture, svg] : drawn(facts.steps))
        page.chart(picture, svg);
      if (!facts.rejected.empty())
        {
          page.open_details("Rejected steps (" + std::to_string(facts.rejected.size()) + ")");
          page.table({"Time [s]", "dt [s]", "outcome", "reason"}, facts.rejected);
          page.close_details();
        }
      const Json ledger = json_in(folder / "ledger.json");
      for (const char *group : {"counts", "seconds"})
        if (ledger.is_object() && ledger.contains(group) && ledger[group].is_object())
          {
            std::vector<Cells> rows;
            for (const auto &[name, value] : ledger[group].items())
              rows.push_back({name, value.is_number() ? number_text(value.get<double>()) : value.dump()});
            page.open_details(std::string("Work: ") + group);
            page.table({"what", group}, rows, true);
            page.close_details();
          }
    }

    void add_scene(const ReportOptions &options, Page &page)
    {
      page.chapter("The scene");
      const std::filesystem::path resolved = options.folder / "scene.resolved.xml";
      try
        {
          std::vector<Cells> rows;
          for (const ChangedValue &changed : options.changed_values(resolved))
            rows.push_back({changed.path, changed.value, changed.usual, changed.meaning});
          page.paragraph("What the scene sets otherwise than the defaults, or must set:");
          page.table({"parameter", "value", "default", "meaning"}, rows);
        }
      catch (const InputError &error)
        {
          page.paragraph(std::string("What differs from the defaults cannot be told any more: ") + error.what(), "note");
        }
      add_file(resolved, "Every value in force (scene.resolved.xml)", page);
    }
  } // namespace

  Report report_of_run(const ReportOptions &options)
  {
    const std::filesystem::path   &folder   = options.folder;
    const Json                     manifest = json_in(folder / "manifest.json");
    const RunFacts                 facts    = facts_of(folder, manifest);
    const auto                     title    = scene::peek_text(folder / "scene.resolved.xml", "title");
    const std::vector<std::string> warnings = texts(manifest, "warnings"), plan = texts(manifest, "plan");

    Report report;
    Page   page;
    page.chapter("At a glance");
    if (!warnings.empty())
      page.list(warnings, "warning");
    page.table({"what", "value"}, facts.glance);
    page.heading("How good are the numbers?");
    page.list(facts.verdicts, "verdict");
    add_body(folder, page, report.notes);
    add_series(folder, page);
    add_work(folder, facts, page);
    page.chapter("What was computed, what was skipped");
    if (plan.empty())
      page.paragraph("The manifest of this run does not say; myolines check SCENE does.");
    page.list(plan);
    add_scene(options, page);
    page.chapter("Where it comes from");
    add_provenance(manifest, page);
    add_file(folder / "run.log", "Log of the run", page);
    const std::string name = (folder / "").lexically_normal().parent_path().filename().string();
    report.html            = page.html(title && !title->empty() ? *title : name);
    return report;
  }
} // namespace myolines::report
