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

  /// Of scenes, folders and every `--out`: a variable of a shell that is not set makes an empty name, which would be taken for the default,
  /// or for the folder that one is in.
  inline void refuse_places_without_a_name(CLI::App &app)
  {
    for (CLI::App *command : app.get_subcommands({}))
      {
        for (CLI::Option *option : command->get_options())
          if (const bool out = option->get_name() == "--out"; out || option->get_positional())
            option->check([out](const std::string &name) {
              return !name.empty() ? "" : out ? "it has no name; leave --out away for the default" : "it has no name";
            });
        refuse_places_without_a_name(*command);
      }
  }
} // namespace myolines
