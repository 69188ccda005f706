// SPDX-License-Identifier: LGPL-2.1-or-later
#include "charts.h"
#include "reports.h"

#include <myolines/base/counted.h>
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/scene/csv.h>
#include <myolines/scene/numbers.h>
#include <myolines/study/cases.h>
#include <myolines/study/plot.h>
#include <myolines/study/results.h>
#include <myolines/study/study.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace myolines::report
{
  namespace
  {
    constexpr std::size_t most_rows = 500;

    std::string settings_text(const std::vector<std::string> &settings) { return settings.empty() ? "the same settings" : join(settings); }

    /// What the study is, in a table.
    std::vector<Cells> glance_of(const study::Study &study, const scene::CsvTable *table)
    {
      std::vector<Cells> glance{{"scene", study.scene.string()}};
      for (const std::string &name : study.axis_names())
        {
          const study::Axis       &axis = study.axis(name);
          std::vector<std::string> labels;
          for (const study::AxisPoint &point : axis.points)
            labels.push_back(point.label);
          glance.push_back({"axis: " + name, join(labels) + (axis.unit.empty() ? "" : " " + axis.unit)});
        }
      for (const study::Quantity &quantity : study.quantities)
        glance.push_back({"quantity", study::header_of(quantity)});
      if (table != nullptr)
        if (const auto status = table->column("status"))
          {
            std::map<std::string, std::size_t> of_status;
            for (const auto &row : table->rows)
              ++of_status[row[*status]];
            std::vector<std::string> words;
            for (const auto &[name, n] : of_status)
              words.push_back(std::to_string(n) + " " + name);
            glance.push_back({"cases", counted(table->rows.size(), "case") + ": " + join(words)});
          }
      return glance;
    }

    /// The differences of reference and cross check: "error in u [m] = 1.2e-07".
    std::string differences(const study::Study &study, const scene::CsvTable &table)
    {
      const auto               role = table.column("role");
      std::vector<std::string> words;
      for (const study::Quantity &quantity : study.quantities)
        if (const auto column = table.column(study::header_of(quantity)); role && column && quantity.is_error())
          for (const auto &row : table.rows)
            if (row[*role] == study::role_name(study::Case::Role::cross_check) && !row[*column].empty())
              words.push_back(study::header_of(quantity) + " = " + number_text(scene::parse_number(row[*column]).value_or(NAN)));
      return join(words);
    }

    /// Against what errors are measured, and how far that may be trusted.
    std::vector<std::string> verdicts_of(const study::Study &study, const scene::CsvTable *table)
    {
      std::vector<std::string> verdicts;
      for (const study::Quantity &quantity : study.quantities)
        if (quantity.is_error() && (quantity.reference_formula || quantity.reference_file))
          verdicts.push_back("\"" + quantity.name + "\" is the difference from " +
                             (quantity.reference_formula ? "the exact solution " + *quantity.reference_formula
                                                         : "the file " + quantity.reference_file->string()) +
                             ".");
      if (study.reference)
        verdicts.push_back("Errors are differences from a reference run, with " + settings_text(study.reference->settings) +
                           (study.reference->instead_of.empty() ? "" : " in place of " + join(study.reference->instead_of)) + ".");
      if (study.cross_check && table != nullptr)
        if (const std::string apart = differences(study, *table); !apart.empty())
          verdicts.push_back("The reference and its cross check, another run with " + settings_text(study.cross_check->settings) +
                             ", differ by " + apart + ": smaller errors mean nothing.");
      if (study.reference && !study.cross_check)
        verdicts.push_back("The reference has no cross check: how good it is itself is not known.");
      verdicts.push_back(study.repeats > 1
                             ? "Seconds are medians of " + std::to_string(study.repeats) + " runs of each case."
                             : "Seconds are those of one run of each case: they depend on the machine and on what else it did.");
      return verdicts;
    }

    /// Cases without results, and what else the table says of some.
    void add_missing(const scene::CsvTable &table, Page &page)
    {
      const auto status = table.column("status"), reason = table.column("reason"), notes = table.column("notes");
      if (!status || !reason || !notes)
        return;
      std::vector<Cells> rows;
      for (const auto &row : table.rows)
        if (row[*status] != "done" || !row[*notes].empty())
          rows.push_back({row.front(), row[*status], row[*reason], row[*notes]});
      page.chapter("What has no value, and why");
      if (rows.empty())
        page.paragraph("Every case has run to its end, and every quantity has a value.");
      else
        page.table({"case", "status", "reason", "notes"}, rows);
    }

    /// Pictures of one kind share the title of the study: what they show distinguishes them.
    void add_title(study::Picture &picture)
    {
      if (picture.panels.empty() && !picture.x_label.empty() && !picture.y_label.empty() && picture.x_words.empty())
        picture.title = picture.y_label + " over " + picture.x_label;
    }

    void add_pictures(const std::filesystem::path &folder, Page &page, std::vector<std::string> &notes)
    {
      page.chapter("Pictures");
      try
        {
          std::vector<study::Picture> pictures = study::pictures_of_study(folder);
          std::for_each(pictures.begin(), pictures.end(), add_title);
          const auto all = drawn(pictures);
          if (all.empty())
            page.paragraph("No case has a number to draw; the notes in the table say why.", "note");
          for (const auto &[picture, svg] : all)
            page.chart(picture, svg);
        }
      catch (const InputError &error)
        {
          notes.push_back(error.what());
          page.paragraph(std::string("There are no pictures: ") + error.what(), "note");
        }
    }
  } // namespace

  Report report_of_study(const ReportOptions &options)
  {
    const std::filesystem::path &folder   = options.folder;
    const std::filesystem::path  resolved = folder / "study.resolved.xml";
    const study::Study           study    = study::read_study(study::read_study_file(resolved));
    Report                       report;
    Page                         page;
    page.chapter("At a glance");
    const auto             cases = scene::read_csv(folder / "study.csv");
    const scene::CsvTable *table = cases ? &*cases : nullptr;
    page.table({"what", "value"}, glance_of(study, table));
    page.heading("How good are the numbers?");
    page.list(verdicts_of(study, table), "verdict");
    if (study.view.target && std::filesystem::exists(folder / "equal_error.csv"))
      {
        page.heading("Cost at equal error: " + study.view.precision + " = " + number_text(*study.view.target));
        page.paragraph(
            "What each method costs, in " + study.view.work +
            ", to reach this error, interpolated between the two cases that enclose it; \"at most\" where all cases are more accurate.");
        add_table(folder / "equal_error.csv", most_rows, page);
      }
    add_pictures(folder, page, report.notes);
    page.chapter("All cases");
    if (!add_table(folder / "study.csv", most_rows, page))
      page.paragraph("There is no table yet: no case has ended.", "note");
    if (std::filesystem::exists(folder / "seconds.csv"))
      {
        page.heading("Seconds");
        page.paragraph("These depend on the machine and on what else it did.", "hint");
        add_table(folder / "seconds.csv", most_rows, page);
      }
    if (table != nullptr)
      add_missing(*table, page);
    page.chapter("The study");
    add_file(resolved, "Every value in force (study.resolved.xml)", page);
    std::error_code none;
    for (const auto &entry : std::filesystem::directory_iterator(folder / "cases", none))
      if (const Json manifest = json_in(entry.path() / "manifest.json"); manifest.is_object())
        {
          page.chapter("Where it comes from");
          page.paragraph("As in the manifest of the case " + entry.path().filename().string() + ".", "hint");
          add_provenance(manifest, page);
          break;
        }
    const std::string name = (folder / "").lexically_normal().parent_path().filename().string();
    report.html            = page.html(study.title.empty() ? name : study.title);
    return report;
  }
} // namespace myolines::report
