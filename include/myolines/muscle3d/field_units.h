// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace myolines
{
  /// Unit of a field that write_fields_vtu() writes: "Pa", "" for pure numbers. Nothing is known of other fields, which have "" too.
  std::string field_unit(const std::string &field);
} // namespace myolines
