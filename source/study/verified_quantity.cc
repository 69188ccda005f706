// SPDX-License-Identifier: LGPL-2.1-or-later
#include "verified_quantity.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/scene/columns.h>
#include <myolines/scene/numbers.h>
#include <myolines/study/csv_table.h>

#include <algorithm>
#include <cmath>

namespace myolines::study
{
  namespace
  {
    using Take = VerifiedQuantity::Take;

    [[noreturn]] void refuse_quantity(const VerifiedQuantity &quantity, const std::string &what, const std::string &expected,
                                      const std::string &hint = "")
    {
      throw InputError(InputProblem{"--quantity \"" + quantity.text + "\"", what, expected, hint});
    }

    /// Takes what says which value is meant off the end of @p column.
    void read_take(std::string &column, VerifiedQuantity &quantity)
    {
      const auto colon = column.rfind(':');
      if (colon == std::string::npos)
        return;
      const std::string word = scene::trimmed(column.substr(colon + 1));
      const auto        time = word.rfind("at ", 0) == 0 ? scene::parse_number(scene::trimmed(word.substr(3))) : std::nullopt;
      if (time)
        quantity.time = *time;
      if (time)
        quantity.take = Take::at;
      else if (word == "largest")
        quantity.take = Take::largest;
      else if (word == "smallest")
        quantity.take = Take::smallest;
      else if (word != "last")
        refuse_quantity(quantity, "\"" + word + "\" is no way to take a value of a column",
                        "nothing, or last, largest, smallest or \"at TIME\" [s] after the second colon");
      column = column.substr(0, colon);
    }

    std::vector<std::string> tables_in(const std::filesystem::path &folder)
    {
      std::vector<std::string> names;
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".csv")
          names.push_back(entry.path().filename().string());
      std::sort(names.begin(), names.end());
      return names;
    }

    CsvTable table_of(const VerifiedQuantity &quantity, const std::filesystem::path &folder)
    {
      const std::vector<std::string> names = tables_in(folder);
      if (std::find(names.begin(), names.end(), quantity.file) == names.end())
        refuse_quantity(quantity, "the runs of this scene write no \"" + quantity.file + "\"", "one of " + join(names),
                        nearest_hint(quantity.file, names));
      const std::optional<CsvTable> table = read_csv(folder / quantity.file);
      if (!table || table->rows.empty())
        refuse_quantity(quantity, quantity.file + " has no rows", "a table with rows");
      return *table;
    }

    std::vector<std::string> without_units(const std::vector<std::string> &header)
    {
      std::vector<std::string> names;
      for (const std::string &name : header)
        names.push_back(scene::split_column_name(name).quantity);
      return names;
    }

    /// The header that is the column, or is without its unit; with other capitals if there is none of these.
    std::string header_in(const VerifiedQuantity &quantity, const CsvTable &table)
    {
      const std::vector<std::string> &header = table.header, names = without_units(header);
      std::vector<std::string>        found;
      for (std::size_t i = 0; i < header.size(); ++i)
        if (header[i] == quantity.column || names[i] == quantity.column)
          found.push_back(header[i]);
      for (std::size_t i = 0; i < header.size() && found.empty(); ++i)
        if (scene::lower_case(names[i]) == scene::lower_case(quantity.column))
          found.push_back(header[i]);
      if (found.empty())
        refuse_quantity(quantity, quantity.file + " has no column \"" + quantity.column + "\"", "one of " + join(header),
                        nearest_hint(scene::lower_case(quantity.column), names));
      if (found.size() > 1)
        refuse_quantity(quantity, quantity.file + " has " + std::to_string(found.size()) + " columns \"" + quantity.column + "\"",
                        "the whole header, with its unit");
      return found.front();
    }

    /// Rows in which the column has a number.
    Series filled(const VerifiedQuantity &quantity, const Series &all)
    {
      Series series;
      for (std::size_t i = 0; i < all.t.size(); ++i)
        if (std::isfinite(all.t[i]) && std::isfinite(all.x[i]))
          {
            series.t.push_back(all.t[i]);
            series.x.push_back(all.x[i]);
          }
      if (series.t.empty())
        refuse_quantity(quantity, "the column has no number in any row", "another column");
      return series;
    }

    /// An eighth of the second difference at the row @p i; 0 at an end.
    double between_rows(const std::vector<double> &x, const std::ptrdiff_t i)
    {
      const bool inside = i > 0 && i + 1 < static_cast<std::ptrdiff_t>(x.size());
      return inside ? std::abs(x[i - 1] - 2 * x[i] + x[i + 1]) / 8 : 0;
    }

    NamedValue taken(const VerifiedQuantity &quantity, const std::string &header, const Series &series)
    {
      const std::vector<double> &x   = series.x;
      const auto                 row = [&](const std::vector<double>::const_iterator at) {
        return NamedValue{header, *at, series.t[at - x.begin()], between_rows(x, at - x.begin())};
      };
      switch (quantity.take)
        {
        case Take::largest:
          return row(std::max_element(x.begin(), x.end()));
        case Take::smallest:
          return row(std::min_element(x.begin(), x.end()));
        case Take::at:
          if (const auto values = reference_at(series, {quantity.time}))
            return {header, values->front(), quantity.time};
          refuse_quantity(quantity, "there is no row at " + scene::format_number(quantity.time) + " s",
                          "a time from " + scene::format_number(series.t.front()) + " s to " + scene::format_number(series.t.back()) +
                              " s");
        case Take::last:
          break;
        }
      return {header, x.back(), series.t.back()};
    }
  } // namespace

  VerifiedQuantity read_verified_quantity(const std::string &text)
  {
    VerifiedQuantity quantity;
    quantity.text    = text;
    const auto colon = text.find(':');
    if (colon == std::string::npos)
      refuse_quantity(quantity, "there is no colon", "FILE:COLUMN, for example \"reaction.csv:moving end x\"");
    std::string column = text.substr(colon + 1);
    read_take(column, quantity);
    quantity.file   = scene::trimmed(text.substr(0, colon));
    quantity.column = scene::trimmed(column);
    return quantity;
  }

  NamedValue value_in_run(const VerifiedQuantity &quantity, const std::filesystem::path &folder)
  {
    const CsvTable    table  = table_of(quantity, folder);
    const std::string header = header_in(quantity, table);
    return taken(quantity, header, filled(quantity, series_of(table, header)));
  }

  Series series_in_run(const VerifiedQuantity &quantity, const std::filesystem::path &folder)
  {
    const CsvTable table = table_of(quantity, folder);
    return filled(quantity, series_of(table, header_in(quantity, table)));
  }

  std::string words_of(const VerifiedQuantity &quantity)
  {
    switch (quantity.take)
      {
      case Take::largest:
        return "largest";
      case Take::smallest:
        return "smallest";
      case Take::at:
        return "at " + scene::format_number(quantity.time) + " s";
      case Take::last:
        break;
      }
    return "last";
  }
} // namespace myolines::study
