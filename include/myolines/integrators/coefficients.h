// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/time/butcher_table.h>

#include <string>

namespace myolines
{
  // Coefficients of Runge-Kutta methods as scenes give them: numbers and fractions such as 1/4, with blanks between them.

  /// Adds the texts `A`, `b` and `embedded`, which count where a table is "own".
  void declare_coefficients(scene::Schema &schema);

  /// The table of @p integrator: rows of A end with their diagonal, b is the last row where there is none. What its diagonal may be is not
  /// looked at. @throws InputError for what is no number, rows and weights of a wrong length, and weights that do not add up to 1.
  ButcherTable read_coefficients(const scene::Node &integrator);

  /// @throws InputError if there are coefficients all the same, as the parameter @p choice has the value @p name.
  void refuse_coefficients(const scene::Node &integrator, const std::string &choice, const std::string &name);
} // namespace myolines
