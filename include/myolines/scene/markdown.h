// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/schema.h>

#include <functional>
#include <string>

namespace myolines::scene
{
  /// @p text with what Markdown and its tables would take for markup escaped; between two backquotes it is code.
  std::string markdown_text(const std::string &text);

  /// @p text as code, in a cell of a table too.
  std::string markdown_code(const std::string &text);

  /// A sentence that says where the parameters of a list are described once for all of its kind; "" for a list that stands for itself.
  using Elsewhere = std::function<std::string(const Schema &)>;

  /// The parameters of @p schema as tables of Markdown: name, meaning, unit, admissible values, default, example. Each list below it has a
  /// table of its own under its path, which begins with @p path ("system/"; "" at the top). The example is a value that the
  /// declaration admits: where it names one, that; else the default; else one that is made from range or choices.
  std::string markdown(const Schema &schema, const std::string &path, const Elsewhere &elsewhere);
} // namespace myolines::scene
