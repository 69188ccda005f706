// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/lanes.h>

#include <string>

namespace myolines
{
  // Apart from lanes.h, which code for wide instruction sets includes.

  /// The one that @p word, "baseline", "avx2" or "avx512", names. @throws InputError if there is none, or this processor does not have it.
  InstructionSet instruction_set_named(const std::string &word);
} // namespace myolines
