#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/scene/csv.h>
#include <myolines/scene/input_text.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace myolines::scene
{
  namespace
  {
    struct Row
    {
      unsigned int             line; ///< that it begins in
      std::vector<std::string> cells;
    };

    /// All complete rows of @p text.
    std::vector<Row> parse(const std::string &text)
    {
      std::vector<Row> rows;
      Row              row{1, {""}};
      unsigned int     line   = 1;
      bool             quoted = false;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          const char c = text[i];
          line += c == '\n' ? 1 : 0;
          if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
            row.cells.back() += text[++i];
          else if (c == '"')
            quoted = !quoted;
          else if (!quoted && c == ',')
            row.cells.emplace_back();
          else if (!quoted && c == '\n')
            {
              rows.push_back(std::move(row));
              row = {line, {""}};
            }
          else if (quoted || c != '\r')
            row.cells.back() += c;
        }
      return rows;
    }

    std::optional<std::string> text_of(const std::filesystem::path &file)
    {
      std::ifstream      stream(file, std::ios::binary);
      std::ostringstream text;
      if (!stream || !(text << stream.rdbuf()))
        return std::nullopt;
      return text.str();
    }

    CsvTable table_of(const std::filesystem::path &file, std::vector<Row> rows)
    {
      CsvTable table{file, std::move(rows.front().cells), {}, {}};
      for (std::size_t row = 1; row < rows.size(); ++row)
        {
          table.rows.push_back(std::move(rows[row].cells));
          table.lines.push_back(rows[row].line);
        }
      return table;
    }
  } // namespace

  std::optional<std::size_t> CsvTable::column(const std::string &name) const
  {
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? std::nullopt : std::optional<std::size_t>(found - header.begin());
  }

  std::size_t CsvTable::required_column(const std::string &name) const
  {
    if (const auto found = column(name))
      return *found;
    throw InputError(InputProblem{file.string(), "there is no column \"" + name + "\"", "one of " + join(header),
                                  nearest_hint(name, header, "nearest valid name")});
  }

  std::vector<double> CsvTable::numbers(const std::size_t column) const
  {
    std::vector<double> all;
    for (std::size_t row = 0; row < rows.size(); ++row)
      {
        const auto value = parse_number(rows[row][column]);
        if (!value)
          throw InputError(InputProblem{where(row), "\"" + rows[row][column] + "\" in column \"" + header[column] + "\"", "a finite number",
                                        "what is missing is left out as a whole line"});
        all.push_back(*value);
      }
    return all;
  }

  std::string CsvTable::where(const std::size_t row) const { return file.string() + ", line " + std::to_string(lines[row]); }

  std::optional<CsvTable> read_csv(const std::filesystem::path &file)
  {
    const std::optional<std::string> text = text_of(file);
    std::vector<Row>                 rows = parse(text.value_or(""));
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
    std::vector<Row> rows = parse(read_input_text(file) + "\n");
    rows.erase(
        std::remove_if(rows.begin(), rows.end(), [](const Row &row) { return row.cells.size() == 1 && trimmed(row.cells[0]).empty(); }),
        rows.end());
    if (rows.empty())
      throw InputError(InputProblem{file.string(), "there is nothing in it", "comma-separated values with names in the first line", ""});
    for (Row &row : rows)
      for (std::string &cell : row.cells)
        cell = trimmed(cell);
    CsvTable table = table_of(file, std::move(rows));
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      if (table.rows[row].size() != table.header.size())
        throw InputError(InputProblem{table.where(row), "has " + std::to_string(table.rows[row].size()) + " fields",
                                      std::to_string(table.header.size()) + ", as many as the first line", ""});
    return table;
  }
} // namespace myolines::scene
