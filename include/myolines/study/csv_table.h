#pragma once

#include <myolines/study/measures.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace myolines::study
{
  /// A CSV file as output/csv_file.h writes it (RFC 4180).
  struct CsvTable
  {
    std::vector<std::string>              header;
    std::vector<std::vector<std::string>> rows;

    /// Index of the column with that header; nothing if there is none.
    std::optional<std::size_t> column(const std::string &name) const;
  };

  /// Nothing if the file cannot be read or a row has not as many fields as the header; a last line that was not finished is
  /// left out.
  std::optional<CsvTable> read_csv(const std::filesystem::path &file);

  /// Column @p name over the first one. What is no number becomes NaN. @throws std::out_of_range if there is no such column.
  Series series_of(const CsvTable &table, const std::string &name);
} // namespace myolines::study
