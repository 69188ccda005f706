// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/muscle3d_system.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// Point and cell fields for visualisation, see write_fields().
  const std::vector<std::string> &field_names();
  /// Those, and for each law of the tissues of a body its "stress of TISSUE LAW".
  std::vector<std::string> field_names(const Muscle3dParameters &parameters);

  /// Writes @p fields (names of field_names(parameters)) of @p state to folder/name.vtu (folder/name.pvtu and its pieces on several ranks),
  /// with high-order cells; returns the file name without the folder. Fields at quadrature points are projected cell-wise (L2, degree of
  /// the pressure, at least one). Collective, as below.
  std::string write_fields_vtu(const Muscle3dSystem &system, const State &state, const std::vector<std::string> &fields,
                               const std::string &folder, unsigned int number);

  /// Points and cells that write_fields_hdf5() writes, on all ranks: every cell in degree^3 parts, with vertices of their own.
  struct FieldSizes
  {
    std::uint64_t points; ///< vertices of the parts, those of neighbours counted each
    std::uint64_t cells;  ///< parts
  };
  FieldSizes field_sizes(const Muscle3dSystem &system); ///< Collective.

  /// Writes @p fields of @p state to the HDF5 file folder/file, one table for each, and, if @p mesh is given, points ("nodes") and vertices
  /// of the cells ("cells") to folder/mesh. The tables of a mesh fit as long as the ranks that share it are the same.
  void write_fields_hdf5(const Muscle3dSystem &system, const State &state, const std::vector<std::string> &fields,
                         const std::string &folder, const std::string &file, const std::optional<std::string> &mesh);

  /// True for the fields with three components.
  bool is_vector_field(const std::string &field);
  /// Unit: "Pa", "" for pure numbers. Nothing is known of fields with other names, which have "" too.
  std::string field_unit(const std::string &field);
  /// The name of @p field in files, without blanks and what else could not stand there.
  std::string field_label(const std::string &field);
} // namespace myolines
