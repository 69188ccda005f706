// SPDX-License-Identifier: LGPL-2.1-or-later
#include "table_dialect.h"

#include <myolines/base/error.h>
#include <myolines/base/files.h>
#include <myolines/base/names.h>
#include <myolines/scene/columns.h>
#include <myolines/scene/csv.h>
#include <myolines/scene/input_text.h>
#include <myolines/scene/numbers.h>

#include <algorithm>

namespace myolines::scene
{
  namespace
  {
    struct Row
    {
      unsigned int             line; ///< that it begins in
      std::vector<std::string> cells;
    };

    struct Rows
    {
      std::vector<Row> complete;
      unsigned int     open_quote = 0; ///< the line of a quotation mark that no other one ends; 0: there is none
    };

    /// All complete rows of @p text, whose first line is number @p line of the file.
    Rows parse(const std::string &text, const char separator = ',', unsigned int line = 1)
    {
      Rows rows;
      Row  row{line, {""}};
      bool quoted = false;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          const char c = text[i];
          line += c == '\n' ? 1 : 0;
          if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
            row.cells.back() += text[++i];
          else if (c == '"')
            {
              quoted          = !quoted;
              rows.open_quote = quoted ? line : 0;
            }
          else if (!quoted && c == separator)
            row.cells.emplace_back();
          else if (!quoted && c == '\n')
            {
              rows.complete.push_back(std::move(row));
              row = {line, {""}};
            }
          else if (quoted || c != '\r')
            row.cells.back() += c;
        }
      return rows;
    }

    std::optional<std::string> text_of(const std::filesystem::path &file)
    {
      if (std::error_code none; !std::filesystem::is_regular_file(file, none))
        return std::nullopt; // a pipe would be waited for
      return read_file(file);
    }

    CsvTable table_of(const std::filesystem::path &file, std::vector<Row> rows)
    {
      CsvTable table{file, std::move(rows.front().cells), {}, {}, {}};
      for (std::size_t row = 1; row < rows.size(); ++row)
        {
          table.rows.push_back(std::move(rows[row].cells));
          table.lines.push_back(rows[row].line);
        }
      return table;
    }
    /// Rows of a person's table: white space around fields, empty lines and empty fields behind the last name are left out.
    std::vector<Row> tidied(std::vector<Row> rows)
    {
      for (Row &row : rows)
        for (std::string &cell : row.cells)
          cell = trimmed(cell);
      const auto is_empty = [](const Row &row) {
        return std::all_of(row.cells.begin(), row.cells.end(), [](const std::string &cell) { return cell.empty(); });
      };
      rows.erase(std::remove_if(rows.begin(), rows.end(), is_empty), rows.end());
      if (rows.empty())
        return rows;
      std::vector<std::string> &names = rows.front().cells;
      while (names.back().empty())
        names.pop_back();
      for (Row &row : rows)
        while (row.cells.size() > names.size() && row.cells.back().empty())
          row.cells.pop_back();
      return rows;
    }

    /// Decimal commas become points, where no field of @p table has a point. @throws InputError where both occur.
    void replace_decimal_commas(CsvTable &table)
    {
      std::optional<std::size_t> comma, point;
      for (std::size_t row = 0; row < table.rows.size(); ++row)
        for (const std::string &cell : table.rows[row])
          if (!comma && with_decimal_point(cell))
            comma = row;
          else if (!point && cell.find('.') != std::string::npos && parse_number(cell))
            point = row;
      if (comma && point)
        throw InputError(InputProblem{table.where(*comma),
                                      "has a decimal comma, and line " + std::to_string(table.lines[*point]) + " a decimal point",
                                      "one of them in the whole table", ""});
      if (comma)
        for (auto &row : table.rows)
          for (std::string &cell : row)
            cell = with_decimal_point(cell).value_or(cell);
    }

    void refuse_missing_names(const CsvTable &table, const unsigned int line)
    {
      const auto is_number = [](const std::string &cell) { return parse_number(cell) || with_decimal_point(cell); };
      if (std::all_of(table.header.begin(), table.header.end(), is_number))
        throw InputError(InputProblem{table.file.string() + ", line " + std::to_string(line),
                                      "there are numbers where the names of the columns should be",
                                      "names in the first line that is no comment, such as \"Time [s]\"", ""});
    }

    /// A line of units below the names, "s,mV" or "[s],[mV]", goes into the names, where it is nothing but units that are known and no name
    /// has a unit of its own.
    void take_units(CsvTable &table)
    {
      if (table.rows.empty())
        return;
      std::vector<std::string> units;
      bool                     any = false;
      for (std::size_t i = 0; i < table.header.size(); ++i)
        {
          const std::string &cell = table.rows[0][i];
          const ColumnName   name = split_column_name(cell);
          units.push_back(name.quantity.empty() ? name.unit : cell);
          any = any || (units[i] != "-" && is_unit(units[i]));
          if ((!units[i].empty() && !is_unit(units[i])) || parse_number(cell) || !split_column_name(table.header[i]).unit.empty())
            return;
        }
      if (!any)
        return;
      for (std::size_t i = 0; i < units.size(); ++i)
        if (!units[i].empty())
          table.header[i] += " [" + units[i] + "]";
      table.rows.erase(table.rows.begin());
      table.lines.erase(table.lines.begin());
    }

    /// What may be wrong with a cell that is no number.
    std::string hint_for_number(const std::string &cell)
    {
      if (cell.find_first_of("0123456789") == std::string::npos)
        return "what is missing is left out as a whole line; a line of units may follow the names, if it knows no others than doc/data.md";
      return "numbers have no units and no marks between thousands, and decimal points where commas separate fields";
    }

    /// A file whose header announces another size has lost some of its table, or was edited by hand.
    void refuse_other_size(const CsvTable &table, const TableText &text)
    {
      const auto require = [&](const std::optional<int> &announced, const std::size_t found, const std::string &what) {
        if (announced && static_cast<std::size_t>(*announced) != found)
          throw InputError(
              InputProblem{table.file.string(),
                           "its header announces " + std::to_string(*announced) + " " + what + ", there are " + std::to_string(found),
                           "as many as announced", "take the whole file, or correct the number in its header"});
      };
      require(text.columns, table.header.size(), "columns");
      require(text.rows, table.rows.size(), "rows");
    }
  } // namespace

  std::optional<std::size_t> CsvTable::column(const std::string &name) const
  {
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? std::nullopt : std::optional<std::size_t>(found - header.begin());
  }

  std::size_t CsvTable::required_column(const std::string &name) const
  {
    const std::vector<std::size_t> found = matching_columns(name, header);
    if (found.size() == 1)
      return found.front();
    if (found.empty())
      {
        std::vector<std::string> quantities;
        for (const std::string &column : header)
          quantities.push_back(split_column_name(column).quantity);
        throw InputError(InputProblem{file.string(), "there is no column \"" + name + "\"", "one of " + join(header),
                                      nearest_hint(split_column_name(name).quantity, quantities, "nearest valid name")});
      }
    std::vector<std::string> names;
    for (const std::size_t i : found)
      names.push_back("\"" + header[i] + "\"");
    throw InputError(InputProblem{file.string(), "several columns may be meant by \"" + name + "\": " + join(names),
                                  "the whole name of one of them, which no other has", ""});
  }

  std::vector<double> CsvTable::numbers(const std::size_t column) const
  {
    std::vector<double> all;
    for (std::size_t row = 0; row < rows.size(); ++row)
      {
        const auto value = parse_number(rows[row][column]);
        if (!value)
          throw InputError(InputProblem{where(row), "\"" + rows[row][column] + "\" in column \"" + header[column] + "\"", "a finite number",
                                        hint_for_number(rows[row][column])});
        all.push_back(*value);
      }
    return all;
  }

  std::string CsvTable::where(const std::size_t row) const { return file.string() + ", line " + std::to_string(lines[row]); }

  std::optional<CsvTable> read_csv(const std::filesystem::path &file)
  {
    const std::optional<std::string> text = text_of(file);
    std::vector<Row>                 rows = parse(text.value_or("")).complete;
    if (rows.empty())
      return std::nullopt;
    CsvTable table = table_of(file, std::move(rows));
    for (const auto &row : table.rows)
      if (row.size() != table.header.size())
        return std::nullopt;
    return table;
  }

  CsvTable read_csv_input(const std::filesystem::path &file)
  {
    const TableText text   = find_table(read_input_text(file), file);
    Rows            parsed = parse(text.text, text.separator, text.line);
    if (parsed.open_quote != 0)
      throw InputError(InputProblem{file.string() + ", line " + std::to_string(parsed.open_quote),
                                    "a quotation mark begins there that none ends: all behind it would be lost",
                                    "quotation marks in pairs, or none", ""});
    std::vector<Row> rows = tidied(std::move(parsed.complete));
    if (rows.empty())
      throw InputError(InputProblem{file.string(), "there is no table in it", "values in columns, with names in the first line", ""});
    CsvTable table   = table_of(file, std::move(rows));
    table.in_degrees = text.in_degrees;
    refuse_missing_names(table, text.line);
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      if (const std::size_t n = table.rows[row].size(), n_names = table.header.size(); n != n_names)
        throw InputError(InputProblem{
            table.where(row), "has " + std::to_string(n) + " fields", std::to_string(n_names) + ", as many as there are names",
            n_names == 1                           ? "lines in front of the names are left out where they begin with #"
            : text.separator == ',' && n > n_names ? "decimal commas cannot be told from commas between fields: separate fields by "
                                                     "semicolons or tabs, or write decimal points"
                                                   : ""});
    refuse_other_size(table, text);
    take_units(table);
    if (text.separator != ',')
      replace_decimal_commas(table);
    return table;
  }
} // namespace myolines::scene
