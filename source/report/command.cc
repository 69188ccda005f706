// SPDX-License-Identifier: LGPL-2.1-or-later
#include "reports.h"

#include <myolines/base/error.h>
#include <myolines/output/manifest.h>
#include <myolines/output/text_file.h>

#include <cmath>

namespace myolines::report
{
  void report_command(const ReportOptions &options, std::ostream &out)
  {
    const bool study = std::filesystem::exists(options.folder / "study.resolved.xml");
    if (!study && !std::filesystem::exists(options.folder / "scene.resolved.xml"))
      throw InputError(InputProblem{options.folder.string(), "there is no run and no study",
                                    "the output folder of a run (scene.resolved.xml) or of a study (study.resolved.xml)", ""});
    const Report                report = study ? report_of_study(options) : report_of_run(options);
    const std::filesystem::path file   = options.out.empty() ? options.folder / "report.html" : options.out;
    replace_file(file, report.html);
    if (options.out.empty() && !study)
      list_in_manifest(options.folder, {"report.html"});
    for (const std::string &note : report.notes)
      out << "Warning: " << note << "\n";
    const Libraries found = libraries(true, true);
    if (!found.missing.empty())
      {
        out << "Warning: diagrams and bodies are drawings only, without the packages";
        for (const std::string &package : found.missing)
          out << " " << package;
        out << " (./myolines.sh install)\n";
      }
    out << "The report is " << file.string() << ", " << std::round(static_cast<double>(report.html.size()) / 1e5) / 10
        << " MB; any browser shows it.\n";
  }
} // namespace myolines::report
