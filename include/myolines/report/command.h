// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace myolines::report
{
  /// A value of a scene that is not its default.
  struct ChangedValue
  {
    std::string path;    ///< of the parameter: "time/step"
    std::string value;   ///< as the scene has it
    std::string usual;   ///< the default; "": there is none
    std::string meaning; ///< a sentence
  };

  /// What `report` is asked for.
  struct ReportOptions
  {
    std::filesystem::path folder; ///< of a run or of a study
    std::filesystem::path out;    ///< empty: report.html in the folder
    /// What the resolved scene in a file changes. Throws InputError where it cannot be read any more.
    std::function<std::vector<ChangedValue>(const std::filesystem::path &)> changed_values;
  };

  /// The command `report`: one HTML file that tells all of a run or a study, and needs no other file and no network. Diagrams and the body
  /// can be read without scripts; with them, the body turns and diagrams tell their values. @throws InputError for a folder that holds
  /// neither; what is missing in it is told in the report.
  void report_command(const ReportOptions &options, std::ostream &out);
} // namespace myolines::report
