// SPDX-License-Identifier: LGPL-2.1-or-later
#include "charts.h"
#include "reports.h"

#include <myolines/base/error.h>
#include <myolines/study/plot.h>
#include <myolines/study/results.h>
#include <myolines/study/study.h>

namespace myolines::report
{
  namespace
  {
    constexpr std::size_t most_rows = 500;

    void add_pictures(const std::filesystem::path &folder, Page &page, std::vector<std::string> &notes)
    {
      page.chapter("Pictures");
      try
        {
          const auto all = drawn(study::pictures_of_study(folder));
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
    std::vector<Cells> glance{{"scene", study.scene.string()}};
    for (const study::Quantity &quantity : study.quantities)
      glance.push_back({"quantity", study::header_of(quantity)});
    page.table({"what", "value"}, glance);
    if (std::filesystem::exists(folder / "equal_error.csv"))
      {
        page.heading("Cost at equal error");
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
