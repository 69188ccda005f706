// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/cli/flexodeal.h>

#include <CLI/CLI.hpp>

namespace myolines
{
  /// What `import flexodeal` takes on the command line.
  void add_flexodeal_options(CLI::App &command, FlexodealOptions &options);
} // namespace myolines
