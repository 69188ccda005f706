// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace CLI
{
  class App;
}

namespace myolines
{
  /// Prints the manual page of @p app with all its commands, in the macros of man(7). All text is that of the help.
  void write_manual(const CLI::App &app, std::ostream &out);

  /// Prints the completion for bash of the command line of @p app: commands, options and fixed sets of values; for some commands,
  /// @p arguments are the words of which the first argument is one. Everything else is completed to names of files.
  void write_bash_completion(const CLI::App &app, const std::map<std::string, std::vector<std::string>> &arguments, std::ostream &out);
} // namespace myolines
