// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/sparse_matrix.h>
#include <myolines/algebra/vector.h>

#include <filesystem>

namespace myolines
{
  /// Writes @p matrix to @p file in the format MatrixMarket (coordinate real general; doi:10.6028/NIST.IR.5935), all digits of its entries.
  /// It keeps its size; rows and columns of the unknowns that @p constraints constrain are left empty. On one rank, @throws
  /// std::logic_error on several; SystemError.
  void write_matrix_market(const SparseMatrix &matrix, const Constraints &constraints, const std::filesystem::path &file);
} // namespace myolines
