// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "page.h"

#include <myolines/report/command.h>

namespace myolines::report
{
  /// A report as a file, and what could not be put into it.
  struct Report
  {
    std::string              html;
    std::vector<std::string> notes;
  };

  Report report_of_run(const ReportOptions &options);
  Report report_of_study(const ReportOptions &options);

  /// A JSON file of the folder; null where it is missing or damaged.
  Json json_in(const std::filesystem::path &file);

  /// "0.1234", of four digits; "" for what is no number.
  std::string number_text(double x);

  /// Version, host, libraries, input files and the like, of a manifest.
  void add_provenance(const Json &manifest, Page &page);

  /// A table of the folder, at most so many rows of it; false if there is none.
  bool add_table(const std::filesystem::path &file, std::size_t most_rows, Page &page);

  /// The text of a file of the folder, closed at first.
  void add_file(const std::filesystem::path &file, const std::string &title, Page &page);
} // namespace myolines::report
