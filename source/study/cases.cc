// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/study/cases.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <set>

namespace myolines::study
{
  namespace
  {
    constexpr std::size_t longest_name = 120; // names of files may have 255 bytes, and others append to it

    std::string file_name(const std::string &text)
    {
      std::string safe = text;
      for (char &c : safe)
        if (!std::isalnum(static_cast<unsigned char>(c)) && std::string("._+-").find(c) == std::string::npos)
          c = '_';
      return safe;
    }

    std::string checksum(const std::string &text)
    {
      boost::crc_32_type crc;
      crc.process_bytes(text.data(), text.size());
      char digits[16];
      std::snprintf(digits, sizeof digits, "%08x", static_cast<unsigned int>(crc.checksum()));
      return digits;
    }

    void append(std::vector<std::string> &list, const std::vector<std::string> &more) { list.insert(list.end(), more.begin(), more.end()); }

    /// The points of one grid, each with the index of every axis.
    std::vector<std::vector<std::size_t>> indices(const Grid &grid)
    {
      std::vector<std::vector<std::size_t>> all{{}};
      for (const Axis &axis : grid.axes)
        {
          std::vector<std::vector<std::size_t>> longer;
          const auto                            zipped =
              std::find_if(grid.axes.begin(), grid.axes.end(), [&axis](const Axis &a) { return a.name == axis.zipped_with; });
          for (const std::vector<std::size_t> &point : all)
            for (std::size_t i = 0; i < axis.points.size(); ++i)
              if (axis.zipped_with.empty() || point[zipped - grid.axes.begin()] == i)
                {
                  longer.push_back(point);
                  longer.back().push_back(i);
                }
          all = std::move(longer);
        }
      return all;
    }

    Case point_case(const Study &study, const Grid &grid, const std::vector<std::size_t> &index)
    {
      Case                                             result;
      std::vector<std::pair<std::string, std::string>> labels;
      result.settings = study.settings;
      for (std::size_t a = 0; a < grid.axes.size(); ++a)
        {
          const AxisPoint &point = grid.axes[a].points[index[a]];
          labels.emplace_back(grid.axes[a].name, point.label);
          result.coordinates.emplace(grid.axes[a].name, point);
          append(result.settings, point.settings);
        }
      result.name = case_name("", labels);
      return result;
    }

    /// The run that @p point is measured against, or its cross check.
    Case reference_case(const Study &study, const Grid &grid, const Case &point, const Reference &reference, const Case::Role role)
    {
      Case                                             result;
      std::vector<std::pair<std::string, std::string>> labels;
      result.role     = role;
      result.settings = study.settings;
      for (const Axis &axis : grid.axes)
        if (std::find(reference.instead_of.begin(), reference.instead_of.end(), axis.name) == reference.instead_of.end())
          {
            const AxisPoint &coordinate = point.coordinates.at(axis.name);
            labels.emplace_back(axis.name, coordinate.label);
            result.coordinates.emplace(axis.name, coordinate);
            append(result.settings, coordinate.settings);
          }
      append(result.settings, reference.settings);
      result.name = case_name(file_name(role_name(role)), labels);
      return result;
    }

    Case repeat_of(const Case &point, const unsigned int number)
    {
      Case repeat     = point;
      repeat.role     = Case::Role::repeat;
      repeat.repeated = point.name;
      repeat.name     = case_name(point.name, {{"repeat", std::to_string(number)}});
      return repeat;
    }

    /// Adds @p made unless a case of that name is there; one that is must be the same.
    void add_once(std::vector<Case> &cases, std::map<std::string, std::size_t> &places, Case made)
    {
      const auto [place, fresh] = places.emplace(made.name, cases.size());
      if (!fresh)
        {
          if (cases[place->second].settings == made.settings)
            return;
          throw InputError(InputProblem{"case " + made.name, "two runs of different settings have this name",
                                        "names of axes and labels that differ in letters and digits",
                                        "or the same order of axes in all grids"});
        }
      cases.push_back(std::move(made));
    }
  } // namespace

  std::string role_name(const Case::Role role)
  {
    switch (role)
      {
      case Case::Role::reference:
        return "reference";
      case Case::Role::cross_check:
        return "cross check";
      case Case::Role::repeat:
        return "repeat";
      case Case::Role::point:
        break;
      }
    return "case";
  }

  std::string case_name(const std::string &prefix, const std::vector<std::pair<std::string, std::string>> &labels)
  {
    std::string name = prefix, whole = prefix;
    for (const auto &[axis, label] : labels)
      {
        name += (name.empty() ? "" : ",") + file_name(axis) + "=" + file_name(label);
        whole += "|" + axis + "=" + label;
      }
    return name.size() <= longest_name ? name : name.substr(0, longest_name - 9) + "-" + checksum(whole);
  }

  std::vector<Case> expand(const Study &study)
  {
    std::vector<Case>                  references, checks, points;
    std::map<std::string, std::size_t> reference_places, check_places;
    std::set<std::string>              names;
    for (const Grid &grid : study.grids)
      for (const std::vector<std::size_t> &index : indices(grid))
        {
          Case point = point_case(study, grid, index);
          if (!names.insert(point.name).second)
            throw InputError(InputProblem{"grid \"" + grid.name + "\"", "the case " + point.name + " is there twice",
                                          "every point once, and labels that differ in letters and digits", ""});
          if (study.reference)
            {
              const Case reference = reference_case(study, grid, point, *study.reference, Case::Role::reference);
              point.reference      = reference.name;
              if (study.cross_check)
                {
                  Case check      = reference_case(study, grid, point, *study.cross_check, Case::Role::cross_check);
                  check.reference = reference.name;
                  add_once(checks, check_places, std::move(check));
                }
              add_once(references, reference_places, reference);
            }
          points.push_back(std::move(point));
        }
    references.insert(references.end(), checks.begin(), checks.end());
    references.insert(references.end(), points.begin(), points.end());
    for (unsigned int number = 2; number <= study.repeats; ++number)
      for (const Case &point : points)
        {
          references.push_back(repeat_of(point, number));
          if (!names.insert(references.back().name).second)
            throw InputError(InputProblem{"repeats", "the name of the repeat " + references.back().name + " is that of a case",
                                          "an axis of another name than \"repeat\"", ""});
        }
    return references;
  }
} // namespace myolines::study
