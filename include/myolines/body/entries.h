// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/system/drive.h>

#include <array>
#include <string>
#include <vector>

namespace myolines
{
  // Entries that several lists of the system "muscle 3d" share.

  extern const std::array<const char *, 3> axes; ///< "x", "y", "z"

  /// Declares three formulas of x, y, z [m] and t [s] (or @p fourth), named prefix + axis, default "0".
  void add_formulas(scene::Schema &schema, const std::string &prefix, const std::string &what, const std::string &fourth = "t [s]");
  /// The text of @p parameter. @throws InputError for what is not one formula of x, y, z and @p fourth (VectorFormula).
  std::string read_formula(const scene::Node &node, const std::string &parameter, const std::string &fourth);
  /// Those of add_formulas(). @throws InputError
  std::array<std::string, 3> read_formulas(const scene::Node &node, const std::string &prefix, const std::string &fourth = "t");

  /// Metres per unit of length: of its name (m, cm, mm, um, ...) or as a number. @throws InputError
  double read_unit(const scene::Node &node, const std::string &parameter);

  /// v over its length. @throws InputError at @p parameter if that is zero or not finite.
  std::array<double, 3> unit_vector(const std::array<double, 3> &v, const scene::Node &node, const std::string &parameter);
  /// The vector of a text "x y z". @throws InputError
  std::array<double, 3> read_vector(const scene::Node &node, const std::string &parameter);
  /// Its unit vector. @throws InputError
  std::array<double, 3> read_direction(const scene::Node &node, const std::string &parameter);

  /// @throws InputError if @p drive leaves @p range at its ends, at its kinks or at many instants of the first second.
  void refuse_values_outside(const scene::Node &node, const Drive &drive, const scene::Range &range, const std::string &quantity);
} // namespace myolines
