// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace myolines
{
  /// Lines with the versions of the program, its compiler and its libraries, and the cell kernels that this processor gets.
  std::string versions_text();
} // namespace myolines
