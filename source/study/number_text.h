// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

namespace myolines::study
{
  /// @p value with @p n significant digits.
  std::string digits(double value, int n);

  /// With two digits more than those that @p error leaves certain.
  std::string value_text(double value, double error);

  /// For a table: all digits; nothing where there is no value.
  std::string cell_of(const std::optional<double> &value);
} // namespace myolines::study
