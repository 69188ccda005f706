#include <myolines/scene/numbers.h>
#include <myolines/study/csv_table.h>

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
} // namespace myolines::study
