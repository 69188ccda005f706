// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/muscle3d_system.h>

#include <string>
#include <vector>

namespace myolines
{
  /// A quantity at quadrature points: the name that Flexodeal gives its column, unit and meaning.
  struct PointColumn
  {
    std::string name;    ///< as Flexodeal has it
    std::string unit;    ///< "Pa", "" for pure numbers
    std::string meaning; ///< a few words
  };
  const std::vector<PointColumn> &point_columns(); ///< All quantities that there are.

  /// Writes @p columns (names of point_columns()) of @p state to the HDF5 file @p file, one table of doubles for each, with its unit as
  /// attribute; attribute "Time [s]" of the file. Rows are the quadrature points of cell after cell, x fastest, cells in the order of
  /// the forest: the same for any number of ranks. Collective. @throws SystemError.
  void write_point_table(const Muscle3dSystem &system, const State &state, const std::vector<std::string> &columns,
                         const std::string &file);
} // namespace myolines
