#pragma once

#include <myolines/scene/csv.h>
#include <myolines/study/measures.h>

#include <string>

namespace myolines::study
{
  using scene::CsvTable;
  using scene::read_csv;

  /// Column @p name over the first one. What is no number becomes NaN. @throws std::out_of_range if there is no such column.
  Series series_of(const CsvTable &table, const std::string &name);
} // namespace myolines::study
