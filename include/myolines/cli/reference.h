// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/integrator.h>

#include <ostream>
#include <string>
#include <vector>

namespace CLI
{
  class App;
}

namespace myolines
{
  /// What is known of a method: order, stability, estimate of its error, systems, reference; indented lines.
  std::string facts_text(const IntegratorEntry &entry);

  /// The pages of the reference, in the order in which they are read.
  std::vector<std::string> reference_topics();

  /// Prints the reference of this program in Markdown, which the manual has as pages: all commands of @p app, and every parameter with
  /// unit, admissible values, default and example. @p topic: one of reference_topics(), or "" for all of them, one after the other.
  /// @throws InputError for another one, with the nearest.
  void reference_command(const std::string &topic, const CLI::App &app, std::ostream &out);
} // namespace myolines
