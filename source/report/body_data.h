// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "page.h"

#include <filesystem>
#include <string>
#include <vector>

namespace myolines::report
{
  /// A body for the report.
  struct BodyData
  {
    std::string              png;     ///< at the first and the last time
    std::string              caption; ///< of it
    Json                     json; ///< what body.js turns: surface, fibres and fields at some times, as bytes in base64; null if too large
    std::vector<Cells>       extremes; ///< least and greatest value of each field: field, value, unit, tissue, time, place at rest
    std::string              fibres;   ///< where those of the muscle shorten and lengthen most; "" if the run did not write the stretch
    std::vector<std::string> notes;    ///< what was left out, and why
  };

  /// From the fields of the run in @p folder. The numbers for the script take at most @p most_bytes: fewer times if they are many.
  BodyData body_data(const std::filesystem::path &folder, std::size_t most_bytes);
} // namespace myolines::report
