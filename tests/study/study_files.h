// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../cli/program_runner.h"

#include <myolines/study/study.h>

#include <string>
#include <utility>
#include <vector>

namespace myolines::testing
{
  // Pieces of study files.

  inline std::string parameter(const std::string &name, const std::string &value, const std::string &type = "string")
  {
    return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
  }

  inline std::string section(const std::string &name, const std::string &contents)
  {
    return "<ParameterList name=\"" + name + "\">\n" + contents + "</ParameterList>\n";
  }

  inline std::string listed(const std::string &name, const std::string &path, const std::string &values, const std::string &more = "")
  {
    return section(name, parameter("type", "list") + parameter("parameter", path) + parameter("values", values) + more);
  }

  inline std::string groups(const std::string &name, const std::vector<std::pair<std::string, std::string>> &points)
  {
    std::string contents = parameter("type", "groups");
    for (const auto &[label, settings] : points)
      contents += section(label, parameter("settings", settings));
    return section(name, contents);
  }

  inline std::string grid(const std::string &name, const std::string &axes) { return section(name, axes); }

  /// A folder with the scene of a free oscillation and studies of it.
  class StudyFolder : public TestFolder
  {
  public:
    StudyFolder()
    {
      write("scene.xml", section("scene", section("system", parameter("type", "oscillator")) +
                                              section("integrator", parameter("type", "backward euler")) +
                                              section("time", parameter("end", "1", "double") + parameter("step", "0.1", "double"))));
    }

    std::filesystem::path write_study(const std::string &grids, const std::string &more = "") const
    {
      return write("study.xml", section("study", parameter("scene", "scene.xml") + section("grids", grids) + more));
    }

    study::Study study(const std::string &grids, const std::string &more = "") const
    {
      return study::read_study(study::read_study_file(write_study(grids, more)));
    }
  };

  /// The largest error of the displacement against cos(t).
  inline std::string error_against_cosine()
  {
    return section("error in u", parameter("file", "trajectory.csv") + parameter("column", "Displacement [m]") +
                                     parameter("measure", "maximum error") + parameter("reference formula", "cos(t)"));
  }
} // namespace myolines::testing
