// SPDX-License-Identifier: LGPL-2.1-or-later
#include "runs_table.h"
#include "number_text.h"

#include <myolines/output/csv_file.h>

namespace myolines::study
{
  void write_runs_table(const std::vector<std::string> &quantities, const std::vector<RunRow> &rows, const std::filesystem::path &folder)
  {
    std::vector<std::string> header{"run", "status", "reason", "CPU [s]"};
    header.insert(header.end(), quantities.begin(), quantities.end());
    CsvFile file(OutputFolder(folder), "runs.csv", header);
    for (const RunRow &row : rows)
      {
        std::vector<std::string> cells{*row.name, row.outcome->status, row.outcome->reason, cell_of(row.outcome->cpu_seconds)};
        for (const std::optional<double> &value : row.values)
          cells.push_back(cell_of(value));
        file.row(cells);
      }
    file.close();
  }
} // namespace myolines::study
