// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/text_file.h>
#include <myolines/study/results.h>

#include <algorithm>
#include <cmath>

namespace myolines::study
{
  namespace
  {
    std::string cell(const Measured &measured) { return measured.value ? exact_text(*measured.value) : ""; }

    /// The labels of all axes but @p except.
    std::map<std::string, std::string> labels(const Case &which, const std::vector<std::string> &except)
    {
      std::map<std::string, std::string> all;
      for (const auto &[axis, point] : which.coordinates)
        if (std::find(except.begin(), except.end(), axis) == except.end())
          all.emplace(axis, point.label);
      return all;
    }

    std::optional<std::size_t> index_of(const Study &study, const std::string &quantity)
    {
      for (std::size_t q = 0; q < study.quantities.size(); ++q)
        if (study.quantities[q].name == quantity)
          return q;
      return std::nullopt;
    }

    /// Why values are missing: "error in u: its reference is not done".
    std::string notes(const Study &study, const Row &row)
    {
      std::vector<std::string> all;
      for (std::size_t q = 0; q < row.values.size(); ++q)
        if (!row.values[q].note.empty())
          all.push_back(study.quantities[q].name + ": " + row.values[q].note);
      return join(all, "; ");
    }

    bool is_of_machine(const Quantity &quantity) { return quantity.source == Quantity::Source::seconds; }

    std::vector<std::string> axis_cells(const Study &study, const Case &which)
    {
      std::vector<std::string> cells;
      for (const std::string &axis : study.axis_names())
        {
          const auto found = which.coordinates.find(axis);
          cells.push_back(found == which.coordinates.end() ? "" : found->second.label);
        }
      return cells;
    }

    void write_study_csv(const Study &study, const std::vector<Row> &rows, const std::filesystem::path &folder)
    {
      const bool               map = study.view.kind == Kind::stability_map, rates = study.view.kind == Kind::convergence;
      std::vector<std::string> header{"case", "role"};
      for (const std::string &axis : study.axis_names())
        header.push_back(axis + (study.axis(axis).unit.empty() ? "" : " [" + study.axis(axis).unit + "]"));
      header.insert(header.end(), {"status", "reason"});
      if (map)
        header.push_back("class");
      for (const Quantity &quantity : study.quantities)
        {
          if (!is_of_machine(quantity))
            header.push_back(header_of(quantity));
          if (rates && quantity.is_error())
            header.push_back("rate of " + quantity.name);
        }
      header.push_back("notes");

      CsvFile file(OutputFolder(folder), "study.csv", header);
      for (const Row &row : rows)
        {
          std::vector<std::string> cells{row.outcome.name, role_name(row.which->role)};
          for (const std::string &label : axis_cells(study, *row.which))
            cells.push_back(label);
          cells.insert(cells.end(), {row.outcome.status, row.outcome.reason});
          if (map)
            cells.push_back(row.stability);
          for (std::size_t q = 0; q < study.quantities.size(); ++q)
            {
              if (!is_of_machine(study.quantities[q]))
                cells.push_back(cell(row.values[q]));
              if (rates && study.quantities[q].is_error())
                cells.push_back(cell(row.rates[q]));
            }
          cells.push_back(notes(study, row));
          file.row(cells);
        }
      file.close();
    }

    void write_seconds_csv(const Study &study, const std::vector<Row> &rows, const std::filesystem::path &folder)
    {
      const bool               repeated = study.repeats > 1;
      std::vector<std::string> header{"case", "CPU [s]", "wall clock [s]"};
      for (const Quantity &quantity : study.quantities)
        if (is_of_machine(quantity))
          header.push_back(header_of(quantity));
      if (repeated)
        {
          header.insert(header.end(), {"runs", "spread of CPU [s]", "spread of wall clock [s]"});
          for (const Quantity &quantity : study.quantities)
            if (is_of_machine(quantity))
              header.push_back("spread of " + header_of(quantity));
        }
      CsvFile file(OutputFolder(folder), "seconds.csv", header);
      for (const Row &row : rows)
        if (row.outcome.status != "open")
          {
            std::vector<std::string> cells{row.outcome.name, cell({row.outcome.cpu_seconds, ""}), exact_text(row.outcome.wall_seconds)};
            for (std::size_t q = 0; q < study.quantities.size(); ++q)
              if (is_of_machine(study.quantities[q]))
                cells.push_back(cell(row.values[q]));
            if (repeated)
              {
                cells.insert(cells.end(), {std::to_string(row.spread.runs), cell({row.spread.cpu, ""}), cell({row.spread.wall, ""})});
                for (std::size_t q = 0; q < study.quantities.size(); ++q)
                  if (is_of_machine(study.quantities[q]))
                    cells.push_back(q < row.spread.values.size() ? cell({row.spread.values[q], ""}) : "");
              }
            file.row(cells);
          }
      file.close();
    }

    std::vector<Result> results_of(const Study &study, const std::vector<Row> &rows)
    {
      std::vector<Result> results;
      for (const Row &row : rows)
        {
          for (std::size_t q = 0; q < study.quantities.size(); ++q)
            {
              results.push_back({row.outcome.name, header_of(study.quantities[q]), row.values[q].value, row.values[q].note});
              if (row.rates[q].value)
                results.push_back({row.outcome.name, "rate of " + study.quantities[q].name, row.rates[q].value, ""});
            }
          if (!row.stability.empty())
            results.push_back({row.outcome.name, "class", {}, row.stability});
        }
      return results;
    }

    /// A place on the curve of a method.
    struct CurvePoint
    {
      double size; ///< number of the case on the axis along the curve
      double error, work;
    };

    /// Number of a case on the first axis but @p curves that has one; points of a curve are neighbours along it.
    double size_of(const Case &which, const std::string &curves)
    {
      for (const auto &[axis, point] : which.coordinates)
        if (axis != curves && point.number)
          return *point.number;
      return 0;
    }

    /// The least work at error @p target on the polygon through @p points.
    Measured work_at(std::vector<CurvePoint> points, const double target)
    {
      std::stable_sort(points.begin(), points.end(), [](const CurvePoint &a, const CurvePoint &b) { return a.size < b.size; });
      Measured least{{}, "no two neighbouring points enclose the target"};
      for (std::size_t i = 0; i + 1 < points.size(); ++i)
        {
          const CurvePoint &a = points[i], &b = points[i + 1];
          if ((a.error - target) * (b.error - target) > 0 || a.error == b.error)
            continue;
          const double work = a.work * std::pow(b.work / a.work, std::log(target / a.error) / std::log(b.error / a.error));
          if (!least.value || work < *least.value)
            least = {work, ""};
        }
      return least;
    }
    /// The least work of @p points if all of them are more accurate than @p target.
    Measured work_at_most(const std::vector<CurvePoint> &points, const double target)
    {
      Measured least;
      for (const CurvePoint &point : points)
        {
          if (!(point.error < target))
            return {};
          if (!least.value || point.work < *least.value)
            least.value = point.work;
        }
      return least;
    }
  } // namespace

  std::string unit_in(const std::string &header)
  {
    const auto begin = header.rfind('['), end = header.rfind(']');
    return begin == std::string::npos || end == std::string::npos || end < begin ? "" : header.substr(begin + 1, end - begin - 1);
  }

  std::string header_of(const Quantity &quantity)
  {
    const bool  pure = quantity.relative || is_ratio(quantity.measure);
    std::string unit;
    if (quantity.source == Quantity::Source::seconds || quantity.measure == "decay time")
      unit = "s";
    else if (quantity.source == Quantity::Source::column && !pure)
      unit = quantity.formula.empty() ? unit_in(quantity.column) : quantity.unit;
    return quantity.name + (unit.empty() ? "" : " [" + unit + "]");
  }

  void add_rates(const Study &study, std::vector<Row> &rows)
  {
    for (Row &row : rows)
      row.rates.assign(study.quantities.size(), {});
    if (study.view.kind != Kind::convergence)
      return;
    const std::string                                               &axis  = study.view.abscissa;
    const std::vector<std::string>                                   along = study.axes_along(axis);
    std::map<std::map<std::string, std::string>, std::vector<Row *>> families;
    for (Row &row : rows)
      if (row.which->role == Case::Role::point && row.which->coordinates.count(axis) > 0)
        families[labels(*row.which, along)].push_back(&row);
    const auto size = [&axis](const Row *row) { return *row->which->coordinates.at(axis).number; };
    for (auto &[others, family] : families)
      {
        std::stable_sort(family.begin(), family.end(), [&size](const Row *a, const Row *b) { return size(a) > size(b); });
        for (std::size_t i = 1; i < family.size(); ++i)
          for (std::size_t q = 0; q < study.quantities.size(); ++q)
            {
              const auto &coarse = family[i - 1]->values[q].value, &fine = family[i]->values[q].value;
              if (study.quantities[q].is_error() && coarse && fine && *coarse > 0 && *fine > 0 && size(family[i - 1]) != size(family[i]))
                family[i]->rates[q].value = std::log(*coarse / *fine) / std::log(size(family[i - 1]) / size(family[i]));
            }
      }
  }

  std::vector<EqualError> equal_error(const Study &study, const std::vector<Row> &rows)
  {
    const View                                    &view      = study.view;
    const std::size_t                              precision = index_of(study, view.precision).value();
    const std::optional<std::size_t>               work      = index_of(study, view.work);
    std::vector<std::string>                       methods;
    std::map<std::string, std::vector<CurvePoint>> curves;
    for (const Row &row : rows)
      if (row.which->role == Case::Role::point && row.which->coordinates.count(view.curves) > 0)
        {
          const std::string           method = row.which->coordinates.at(view.curves).label;
          const std::optional<double> e = row.values[precision].value, w = work ? row.values[*work].value : row.outcome.cpu_seconds;
          if (curves.count(method) == 0)
            methods.push_back(method);
          std::vector<CurvePoint> &points = curves[method];
          if (e && w && *e > 0 && *w > 0)
            points.push_back({size_of(*row.which, view.curves), *e, *w});
        }
    std::vector<EqualError> costs;
    std::optional<double>   least;
    bool                    is_bound = false;
    for (const std::string &method : methods)
      {
        costs.push_back({method, work_at(curves[method], view.target.value()), {}, {}});
        if (!costs.back().work.value)
          costs.back().at_most = work_at_most(curves[method], view.target.value());
        if (costs.back().at_most.value)
          costs.back().work.note = "all its points are more accurate";
        for (const auto &w : {costs.back().work.value, costs.back().at_most.value})
          if (w && (!least || *w < *least))
            {
              least    = w;
              is_bound = !costs.back().work.value;
            }
      }
    for (EqualError &cost : costs)
      if (cost.work.value && !is_bound)
        cost.ratio.value = *cost.work.value / *least;
    return costs;
  }

  void write_tables(const Study &study, const std::vector<Row> &rows, const std::filesystem::path &folder, Database &database)
  {
    write_study_csv(study, rows, folder);
    write_seconds_csv(study, rows, folder);
    if (study.view.target)
      {
        CsvFile file(OutputFolder(folder), "equal_error.csv",
                     {study.view.curves, study.view.work, "at most", "over the cheapest", "notes"});
        for (const EqualError &cost : equal_error(study, rows))
          file.row({cost.method, cell(cost.work), cell(cost.at_most), cell(cost.ratio), cost.work.note});
        file.close();
      }
    database.replace_results(results_of(study, rows));
  }
} // namespace myolines::study
