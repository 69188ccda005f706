// SPDX-License-Identifier: LGPL-2.1-or-later
#include "number_text.h"

#include <myolines/output/text_file.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines::study
{
  std::string digits(const double value, const int n)
  {
    std::ostringstream text;
    text.precision(n);
    text << value;
    return text.str();
  }

  std::string value_text(const double value, const double error)
  {
    const double certain = error > 0 && value != 0 ? std::log10(std::abs(value) / error) : 10;
    return digits(value, static_cast<int>(std::clamp(certain + 3, 4., 12.)));
  }

  std::string cell_of(const std::optional<double> &value) { return value ? exact_text(*value) : ""; }
} // namespace myolines::study
