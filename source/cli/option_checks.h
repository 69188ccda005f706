// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/numbers.h>

#include <CLI/CLI.hpp>

#include <string>

namespace myolines
{
  /// A count: an integer of at least 1.
  inline CLI::Validator at_least_one()
  {
    return CLI::Validator(
        [](const std::string &text) {
          const auto number = scene::parse_integer(text);
          return number && *number >= 1 ? std::string() : "\"" + text + "\" is no count\n  expected: an integer >= 1";
        },
        "");
  }

  /// Of every `--out`: a variable of a shell that is not set makes an empty name, which would be taken for the default.
  inline void refuse_places_without_a_name(CLI::App &app)
  {
    for (CLI::App *command : app.get_subcommands({}))
      if (CLI::Option *out = command->get_option_no_throw("--out"))
        out->check([](const std::string &name) { return name.empty() ? "it has no name; leave --out away for the default" : ""; });
  }
} // namespace myolines
