#include <myolines/scene/numbers.h>
#include <myolines/study/csv_table.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace myolines::study
{
  namespace
  {
    /// All complete rows of @p text.
    std::vector<std::vector<std::string>> parse(const std::string &text)
    {
      std::vector<std::vector<std::string>> rows;
      std::vector<std::string>              row(1);
      bool                                  quoted = false;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          const char c = text[i];
          if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
            row.back() += text[++i];
          else if (c == '"')
            quoted = !quoted;
          else if (!quoted && c == ',')
            row.emplace_back();
          else if (!quoted && c == '\n')
            {
              rows.push_back(std::move(row));
              row = std::vector<std::string>(1);
            }
          else if (quoted || c != '\r')
            row.back() += c;
        }
      return rows;
    }
  } // namespace

  std::optional<std::size_t> CsvTable::column(const std::string &name) const
  {
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? std::nullopt : std::optional<std::size_t>(found - header.begin());
  }

  std::optional<CsvTable> read_csv(const std::filesystem::path &file)
  {
    std::ifstream      stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || !(text << stream.rdbuf()))
      return std::nullopt;
    CsvTable table;
    table.rows = parse(text.str());
    if (table.rows.empty())
      return std::nullopt;
    table.header = std::move(table.rows.front());
    table.rows.erase(table.rows.begin());
    for (const auto &row : table.rows)
      if (row.size() != table.header.size())
        return std::nullopt;
    return table;
  }

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
} // namespace myolines::study
