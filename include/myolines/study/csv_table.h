// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/csv.h>
#include <myolines/study/measures.h>

#include <map>
#include <string>

namespace myolines::study
{
  using scene::CsvTable;
  using scene::read_csv;

  /// Column @p name over the first one. What is no number becomes NaN. @throws std::out_of_range if there is no such column.
  Series series_of(const CsvTable &table, const std::string &name);

  /// @p formula (muParser, with pi) over the first column, whose name is t; @p columns are names in it and their headers.
  /// @throws std::out_of_range if there is no such column, std::invalid_argument, with what is wrong, if it is no formula in these names.
  Series series_of_formula(const CsvTable &table, const std::string &formula, const std::map<std::string, std::string> &columns);
} // namespace myolines::study
