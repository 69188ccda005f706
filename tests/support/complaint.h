// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>

#include <functional>
#include <string>

namespace myolines::test
{
  /// The message of the InputError that @p action throws, "" if it throws none.
  inline std::string complaint(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace myolines::test
