// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/meshes/field_grid.h>

#include <filesystem>

namespace myolines::picture
{
  /// Points and cells from @p mesh ("nodes", "cells"), fields from the tables of @p fields, as runs write them in HDF5.
  /// @throws InputError for files that are missing or damaged.
  FieldGrid read_hdf5_fields(const std::filesystem::path &mesh, const std::filesystem::path &fields);
} // namespace myolines::picture
