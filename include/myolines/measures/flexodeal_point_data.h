// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/muscle3d_system.h>

#include <filesystem>

namespace myolines
{
  // The tables of all quadrature points in the binary format of Flexodeal (thesis, tables 6.2 and 6.3): rows of 32-bit numbers, point after
  // point, cells in the order of the forest, x fastest within a cell. Collective. @throws SystemError.

  constexpr unsigned int n_main_columns   = 21; ///< numbers in a row of the main table
  constexpr unsigned int n_tensor_columns = 69; ///< numbers in a row of that of tensors

  /// Positions, JxW, det F, displacement, velocity, pressure, dilatation, stretches, strain rates, fibre vector, tissue.
  void write_main_points(const Muscle3dSystem &system, const State &state, const std::filesystem::path &file);

  /// Positions, JxW, det F, F and the Kirchhoff stress: total, volumetric, isochoric, active, passive and base of the muscle; tissue.
  void write_tensor_points(const Muscle3dSystem &system, const State &state, const std::filesystem::path &file);
} // namespace myolines
