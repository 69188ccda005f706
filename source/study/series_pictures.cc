// SPDX-License-Identifier: LGPL-2.1-or-later
#include "series_pictures.h"

#include <myolines/base/names.h>
#include <myolines/scene/numbers.h>
#include <myolines/study/cases.h>
#include <myolines/study/csv_table.h>
#include <myolines/study/runner.h>

#include <algorithm>
#include <set>

namespace myolines::study
{
  namespace
  {
    std::vector<std::string> labels_of(const Study &study, const std::string &axis)
    {
      std::vector<std::string> labels;
      for (const Grid &grid : study.grids)
        for (const Axis &each : grid.axes)
          for (const AxisPoint &point : each.points)
            if (each.name == axis)
              labels.push_back(point.label);
      return labels;
    }

    bool contains(const std::vector<std::string> &all, const std::string &one)
    {
      return std::find(all.begin(), all.end(), one) != all.end();
    }

    bool wanted(const SeriesPicture &picture, const Case &which)
    {
      return std::all_of(picture.of.begin(), picture.of.end(), [&which](const auto &choice) {
        const auto found = which.coordinates.find(choice.first);
        return found != which.coordinates.end() && contains(choice.second, found->second.label);
      });
    }

    /// The labels of the case on the axes that the picture does not fix.
    std::string title_of(const Study &study, const SeriesPicture &picture, const Case &which)
    {
      std::vector<std::string> labels;
      for (const std::string &axis : study.axis_names())
        if (const auto fixed = picture.of.find(axis); fixed == picture.of.end() || fixed->second.size() > 1)
          if (const auto found = which.coordinates.find(axis); found != which.coordinates.end())
            labels.push_back(found->second.label);
      return join(labels);
    }

    std::set<std::string> done_cases(const std::filesystem::path &folder)
    {
      std::set<std::string> names;
      if (const std::optional<CsvTable> table = read_csv(folder / "study.csv"))
        if (const auto status = table->column("status"))
          for (const auto &row : table->rows)
            if (row[*status] == "done")
              names.insert(row.front());
      return names;
    }

    Picture frame(const SeriesPicture &wanted, const std::string &title, const std::string &x_label, const std::string &y_label)
    {
      Picture picture;
      picture.name = wanted.name;
      std::replace_if(
          picture.name.begin(), picture.name.end(), [](const unsigned char c) { return !std::isalnum(c) && c != '.' && c != '-'; }, '_');
      picture.title   = title;
      picture.x_label = x_label;
      picture.y_label = y_label;
      picture.marks   = false;
      picture.log_y   = wanted.logarithmic;
      return picture;
    }

    Curve curve(const SeriesPicture &picture, const CsvTable &table, const std::string &over, const std::string &column,
                const std::string &title)
    {
      Curve curve{title, {}};
      for (const auto &row : table.rows)
        {
          const auto x = scene::parse_number(row[*table.column(over)]), y = scene::parse_number(row[*table.column(column)]);
          if (x && y && !(picture.from && *x < *picture.from) && !(picture.until && *x > *picture.until))
            curve.points.emplace_back(*x, *y);
        }
      return curve;
    }

    Picture series_picture(const Study &study, const SeriesPicture &wanted_picture, const std::vector<Case> &cases,
                           const std::set<std::string> &done, const std::filesystem::path &folder)
    {
      std::vector<Picture> panels;
      for (const std::string &column : wanted_picture.columns)
        panels.push_back(frame(wanted_picture, column, wanted_picture.over, ""));
      for (const Case &which : cases)
        {
          if (which.role != Case::Role::point || done.count(which.name) == 0 || !wanted(wanted_picture, which))
            continue;
          const std::optional<CsvTable> table = read_csv(case_folder(folder, which.name) / wanted_picture.file);
          if (!table)
            continue;
          const std::string over = wanted_picture.over.empty() ? table->header.front() : wanted_picture.over;
          for (std::size_t i = 0; i < panels.size(); ++i)
            if (table->column(over) && table->column(wanted_picture.columns[i]))
              {
                panels[i].x_label = over;
                panels[i].curves.push_back(
                    curve(wanted_picture, *table, over, wanted_picture.columns[i], title_of(study, wanted_picture, which)));
              }
        }
      Picture whole = frame(wanted_picture, study.title + ": " + wanted_picture.name, "", "");
      whole.panels  = panels;
      return whole;
    }
  } // namespace

  SeriesPicture read_series_picture(const scene::Node &node, const Study &study)
  {
    SeriesPicture picture{node.name(), node.text("file"), split(node.text("columns")), node.text("over"), {}, false, {}, {}};
    if (picture.columns.empty())
      node.refuse("columns", "there is no column", "headers separated by |");
    for (const std::string &choice : split(node.text("of")))
      {
        const auto                     equals = choice.find('=');
        const std::string              axis   = scene::trimmed(choice.substr(0, equals));
        const std::string              label  = equals == std::string::npos ? "" : scene::trimmed(choice.substr(equals + 1));
        const std::vector<std::string> axes = study.axis_names(), labels = labels_of(study, axis);
        if (!contains(axes, axis))
          node.refuse("of", "there is no axis \"" + axis + "\"", "axis=label, with an axis out of " + join(axes), nearest_hint(axis, axes));
        if (!contains(labels, label))
          node.refuse("of", "the axis \"" + axis + "\" has no point \"" + label + "\"", "one of " + join(labels),
                      nearest_hint(label, labels));
        picture.of[axis].push_back(label);
      }
    picture.logarithmic = node.boolean("logarithmic");
    if (node.has("from"))
      picture.from = node.number("from");
    if (node.has("until"))
      picture.until = node.number("until");
    return picture;
  }

  std::vector<Picture> series_pictures(const Study &study, const std::filesystem::path &folder)
  {
    std::vector<Picture> pictures;
    if (study.pictures.empty())
      return pictures;
    const std::vector<Case>     cases = expand(study);
    const std::set<std::string> done  = done_cases(folder);
    for (const SeriesPicture &wanted : study.pictures)
      pictures.push_back(series_picture(study, wanted, cases, done, folder));
    return pictures;
  }
} // namespace myolines::study
