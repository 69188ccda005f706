// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cerrno>

namespace myolines
{
  /// Whether a call failed for the name that it was given (permission, no such folder), which is wrong input, and not for what has nothing
  /// to do with the name (disk full, memory). @p error: errno.
  inline bool is_of_the_name(const int error)
  {
    for (const int other : {ENOSPC, EDQUOT, EIO, EFBIG, ENOMEM, ENFILE, EMFILE})
      if (error == other)
        return false;
    return true;
  }
} // namespace myolines
