// SPDX-License-Identifier: LGPL-2.1-or-later
#include "series_pictures.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/scene/numbers.h>
#include <myolines/study/csv_table.h>
#include <myolines/study/plot.h>
#include <myolines/study/results.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace myolines::study
{
  namespace
  {
    /// study.csv with the columns of seconds.csv behind, rows of points only.
    class PointTable
    {
    public:
      PointTable(const Study &study, const std::filesystem::path &folder)
        : study_(study)
      {
        const std::optional<CsvTable> main = read_csv(folder / "study.csv"), seconds = read_csv(folder / "seconds.csv");
        if (!main || !seconds)
          throw InputError(InputProblem{(folder / "study.csv").string(), "there is no table", "what a study leaves when it has run",
                                        "run the study first: myolines study"});
        table_.header = main->header;
        table_.header.insert(table_.header.end(), seconds->header.begin() + 1, seconds->header.end());
        std::map<std::string, std::vector<std::string>> of_case;
        for (const auto &row : seconds->rows)
          of_case.emplace(row.front(), std::vector<std::string>(row.begin() + 1, row.end()));
        for (auto row : main->rows)
          if (const auto found = of_case.find(row.front()); row[1] == role_name(Case::Role::point) && found != of_case.end())
            {
              row.insert(row.end(), found->second.begin(), found->second.end());
              table_.rows.push_back(row);
            }
      }

      std::size_t n_rows() const { return table_.rows.size(); }

      /// "" where there is no such column.
      std::string text(const std::size_t row, const std::string &header) const
      {
        const auto column = table_.column(header);
        return column ? table_.rows[row][*column] : "";
      }
      double number(const std::size_t row, const std::string &header) const
      {
        return scene::parse_number(text(row, header)).value_or(std::numeric_limits<double>::quiet_NaN());
      }
      std::string axis_header(const std::string &axis) const
      {
        const std::string unit = study_.axis(axis).unit;
        return axis + (unit.empty() ? "" : " [" + unit + "]");
      }

      /// A row on all axes but @p except, for people: "method be, step 0.01 s".
      std::string others_in_words(const std::size_t row, const std::vector<std::string> &except) const
      {
        std::vector<std::string> words;
        for (const std::string &axis : study_.axis_names())
          if (std::find(except.begin(), except.end(), axis) == except.end())
            {
              const std::string unit = study_.axis(axis).unit;
              words.push_back(axis + " " + text(row, axis_header(axis)) + (unit.empty() ? "" : " " + unit));
            }
        return join(words);
      }

      /// A row on all axes but @p except, "method be, step 0.01"; the label alone if it is one axis.
      std::string others(const std::size_t row, const std::vector<std::string> &except) const
      {
        std::vector<std::string> labels, with_axes;
        for (const std::string &axis : study_.axis_names())
          if (std::find(except.begin(), except.end(), axis) == except.end())
            {
              labels.push_back(text(row, axis_header(axis)));
              with_axes.push_back(axis + " " + labels.back());
            }
        return labels.size() == 1 ? labels.front() : join(with_axes);
      }

    private:
      const Study &study_;
      CsvTable     table_;
    };

    std::string picture_file_name(std::string text)
    {
      for (char &c : text)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.')
          c = '_';
      return text;
    }

    Picture titled(const Study &study, const std::string &name, const std::string &x_label, const std::string &y_label)
    {
      Picture picture;
      picture.name    = picture_file_name(name);
      picture.title   = study.title;
      picture.x_label = x_label;
      picture.y_label = y_label;
      return picture;
    }

    Curve &curve_named(Picture &picture, const std::string &title)
    {
      for (Curve &curve : picture.curves)
        if (curve.title == title)
          return curve;
      picture.curves.push_back({title, {}});
      return picture.curves.back();
    }

    /// @p y over @p x, both headers of the table; a curve for each point of the axes that are not in @p along. Points of a curve are
    /// joined in the order of their numbers on the first axis of @p along that has any.
    Picture diagram(const Study &study, const PointTable &table, const std::string &name, const std::string &x, const std::string &y,
                    const std::vector<std::string> &along)
    {
      const auto number = [&](const std::size_t row) {
        for (const std::string &axis : along)
          if (const double value = table.number(row, table.axis_header(axis)); !std::isnan(value))
            return value;
        return 0.;
      };
      std::vector<std::size_t> order(table.n_rows());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(), [&number](const std::size_t a, const std::size_t b) { return number(a) < number(b); });

      Picture picture = titled(study, name, x, y);
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        curve_named(picture, table.others(row, along)); // in the order of the table
      for (const std::size_t row : order)
        if (!table.text(row, x).empty())
          curve_named(picture, table.others(row, along)).points.emplace_back(table.number(row, x), table.number(row, y));
      return picture;
    }

    /// "" if there is none.
    std::string first_with_numbers(const Study &study)
    {
      for (const std::string &name : study.axis_names())
        {
          const auto &points = study.axis(name).points;
          if (std::all_of(points.begin(), points.end(), [](const AxisPoint &p) { return p.number.has_value(); }))
            return name;
        }
      return "";
    }

    bool is_among(const std::string &name, const std::vector<std::string> &names)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    /// The quantities that share a picture over @p axis: the curves of each have its name.
    Picture shared_diagram(const Study &study, const PointTable &table, const std::string &axis)
    {
      Picture               shared = titled(study, join(study.view.together) + " over " + axis, table.axis_header(axis), "");
      std::set<std::string> units;
      for (const Quantity &quantity : study.quantities)
        if (is_among(quantity.name, study.view.together))
          {
            units.insert(unit_in(header_of(quantity)));
            for (Curve &curve : diagram(study, table, quantity.name, table.axis_header(axis), header_of(quantity), {axis}).curves)
              shared.curves.push_back({quantity.name + (curve.title.empty() ? "" : ", " + curve.title), std::move(curve.points)});
          }
      shared.y_label = units.size() == 1 && !units.begin()->empty() ? "[" + *units.begin() + "]" : "";
      return shared;
    }

    /// Whether numbers want a logarithmic axis: all are positive, and they span two decades or more.
    bool spans_decades(const Picture &picture, double std::pair<double, double>::*coordinate)
    {
      double low = std::numeric_limits<double>::infinity(), high = 0;
      for (const Curve &curve : picture.curves)
        for (const auto &point : curve.points)
          if (std::isfinite(point.first) && std::isfinite(point.second))
            {
              low  = std::min(low, point.*coordinate);
              high = std::max(high, point.*coordinate);
            }
      return low > 0 && high >= 100 * low;
    }

    std::vector<Picture> sweep_pictures(const Study &study, const PointTable &table)
    {
      const std::string    axis = study.view.abscissa.empty() ? first_with_numbers(study) : study.view.abscissa;
      std::vector<Picture> pictures;
      if (axis.empty() && !study.pictures.empty()) // time series say it all
        return pictures;
      if (axis.empty())
        throw InputError(InputProblem{"study", "no axis has numbers, there is nothing to draw along",
                                      "an axis of numbers, or a list \"pictures\" of time series", ""});
      for (const Quantity &quantity : study.quantities)
        if (!is_among(quantity.name, study.view.together))
          pictures.push_back(diagram(study, table, quantity.name + " over " + axis, table.axis_header(axis), header_of(quantity), {axis}));
      if (!study.view.together.empty())
        pictures.push_back(shared_diagram(study, table, axis));
      for (Picture &picture : pictures)
        {
          picture.log_x = spans_decades(picture, &std::pair<double, double>::first);
          picture.log_y = spans_decades(picture, &std::pair<double, double>::second);
        }
      return pictures;
    }

    /// Every error over CPU seconds and over every count and phase. Other axes than that of the curves run along them.
    std::vector<Picture> work_precision_pictures(const Study &study, const PointTable &table)
    {
      std::vector<std::string> along = study.axis_names();
      along.erase(std::remove(along.begin(), along.end(), study.view.curves), along.end());
      std::vector<std::pair<std::string, std::string>> works;
      for (const Quantity &quantity : study.quantities)
        if (quantity.source == Quantity::Source::count || quantity.source == Quantity::Source::seconds)
          works.emplace_back(quantity.name, header_of(quantity));
      works.emplace_back("CPU seconds", "CPU [s]"); // after what does not depend on the machine
      std::vector<Picture> pictures;
      for (const Quantity &quantity : study.quantities)
        if (quantity.is_error())
          for (const auto &[name, header] : works)
            {
              Picture picture = diagram(study, table, quantity.name + " over " + name, header, header_of(quantity), along);
              picture.log_x = picture.log_y = true;
              pictures.push_back(picture);
            }
      return pictures;
    }

    std::vector<Picture> convergence_pictures(const Study &study, const PointTable &table)
    {
      std::vector<Picture> pictures;
      for (const Quantity &quantity : study.quantities)
        if (quantity.is_error())
          {
            const std::string &axis = study.view.abscissa;
            Picture picture         = diagram(study, table, quantity.name + " over " + axis, table.axis_header(axis), header_of(quantity),
                                              study.axes_along(axis));
            picture.log_x = picture.log_y = true;
            pictures.push_back(picture);
          }
      return pictures;
    }

    /// Where the points of an axis stand in a map: at their numbers if all are positive, else one after the other, with their labels.
    struct MapAxis
    {
      std::map<std::string, double>               place;
      std::vector<std::pair<double, std::string>> words;
      bool                                        logarithmic = true;
    };

    MapAxis map_axis(const Study &study, const std::string &name)
    {
      MapAxis axis;
      for (const Grid &grid : study.grids)
        for (const Axis &each : grid.axes)
          for (const AxisPoint &point : each.points)
            axis.logarithmic = axis.logarithmic && (each.name != name || (point.number && *point.number > 0));
      for (const Grid &grid : study.grids)
        for (const Axis &each : grid.axes)
          if (each.name == name)
            for (const AxisPoint &point : each.points)
              if (axis.place.emplace(point.label, axis.logarithmic ? *point.number : static_cast<double>(axis.place.size())).second)
                axis.words.emplace_back(axis.place.at(point.label), point.label);
      return axis;
    }

    std::vector<Picture> map_pictures(const Study &study, const PointTable &table)
    {
      const MapAxis              x = map_axis(study, study.view.abscissa), y = map_axis(study, study.view.ordinate);
      std::map<std::string, int> known; // others -> index
      std::vector<Picture>       pictures;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        {
          const std::string others  = table.others(row, {study.view.abscissa, study.view.ordinate});
          const auto [found, fresh] = known.emplace(others, static_cast<int>(pictures.size()));
          if (fresh)
            {
              Picture           map   = titled(study, "map" + (others.empty() ? "" : " " + others), table.axis_header(study.view.abscissa),
                                               table.axis_header(study.view.ordinate));
              const std::string words = table.others_in_words(row, {study.view.abscissa, study.view.ordinate});
              map.title += words.empty() ? "" : ": " + words;
              map.log_x   = x.logarithmic;
              map.log_y   = y.logarithmic;
              map.lines   = false;
              map.x_words = x.words;
              map.y_words = y.words;
              for (const char *name : {"stable", "oscillating", "diverged", "failed", "unknown"}) // the same marks in all maps
                map.curves.push_back({name, {}});
              pictures.push_back(map);
            }
          const std::string label_x = table.text(row, table.axis_header(study.view.abscissa)),
                            label_y = table.text(row, table.axis_header(study.view.ordinate));
          if (x.place.count(label_x) > 0 && y.place.count(label_y) > 0)
            curve_named(pictures[found->second], table.text(row, "class")).points.emplace_back(x.place.at(label_x), y.place.at(label_y));
        }
      return pictures;
    }
  } // namespace

  namespace
  {
    std::vector<Picture> pictures_by_kind(const Study &study, const PointTable &table)
    {
      switch (study.view.kind)
        {
        case Kind::sweep:
          return sweep_pictures(study, table);
        case Kind::work_precision:
          return work_precision_pictures(study, table);
        case Kind::convergence:
          return convergence_pictures(study, table);
        case Kind::stability_map:
          return map_pictures(study, table);
        }
      throw std::logic_error("unknown kind of study");
    }
  } // namespace

  std::vector<Picture> pictures_of_study(const std::filesystem::path &folder)
  {
    const Study          study    = read_study(read_study_file(folder / "study.resolved.xml"));
    std::vector<Picture> pictures = pictures_by_kind(study, PointTable(study, folder));
    for (Picture &picture : series_pictures(study, folder))
      pictures.push_back(std::move(picture));
    return pictures;
  }
} // namespace myolines::study
