// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/scene/numbers.h>
#include <myolines/study/csv_table.h>

#include <deal.II/base/numbers.h>

#include <muParser.h>

#include <limits>
#include <stdexcept>

namespace myolines::study
{
  Series series_of(const CsvTable &table, const std::string &name)
  {
    const std::optional<std::size_t> column = table.column(name);
    if (!column)
      throw std::out_of_range("no column " + name);
    Series     series;
    const auto number = [](const std::string &text) {
      return scene::parse_number(text).value_or(std::numeric_limits<double>::quiet_NaN());
    };
    for (const auto &row : table.rows)
      {
        series.t.push_back(number(row.front()));
        series.x.push_back(number(row[*column]));
      }
    return series;
  }

  Series series_of_formula(const CsvTable &table, const std::string &formula, const std::map<std::string, std::string> &columns)
  {
    std::vector<std::pair<Series, double>> used; // with the place that the parser reads
    for (const auto &[name, header] : columns)
      used.emplace_back(series_of(table, header), 0.);
    Series result;
    double t = 0;
    try
      {
        mu::Parser parser;
        parser.DefineConst("pi", dealii::numbers::PI);
        parser.DefineVar("t", &t);
        auto place = used.begin();
        for (const auto &[name, header] : columns)
          parser.DefineVar(name, &place++->second);
        parser.SetExpr(formula);
        parser.Eval(); // also of a table without rows
        result.t = series_of(table, table.header.front()).t;
        for (std::size_t row = 0; row < result.t.size(); ++row)
          {
            t = result.t[row];
            for (auto &[series, value] : used)
              value = series.x[row];
            result.x.push_back(parser.Eval());
          }
      }
    catch (const mu::Parser::exception_type &error)
      {
        throw std::invalid_argument(error.GetMsg());
      }
    return result;
  }
} // namespace myolines::study
