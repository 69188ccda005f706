// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace myolines
{
  /// Distributed sparse matrix, rows spread like the entries of a Vector.
  using SparseMatrix = dealii::TrilinosWrappers::SparseMatrix;

  /// The locally owned rows of a SparseMatrix as plain compressed rows, for kernels that fill it without searching.
  /// Entry k of row i (local number) stands at values[row_start[i] + k], its column has the local number
  /// columns[row_start[i] + k]; global_column() translates. Valid while the matrix lives and its pattern stands.
  struct CompressedRows
  {
    const int *row_start; ///< where each row begins in the lists below
    const int *columns;   ///< of the entries, row by row
    double    *values;    ///< of the entries, row by row
  };

  /// Raw access to @p matrix, which must have a fixed pattern.
  CompressedRows compressed_rows(SparseMatrix &matrix);

  /// Gives the memory of the entries of @p matrix back, while its pattern stays. Before anything reads them, and
  /// before the matrix is destroyed, provide_entries() has to bring them back: Epetra takes rows without them for rows of their own.
  void release_entries(SparseMatrix &matrix);

  /// Brings entries that release_entries() has taken back, with any values; does nothing where they are there.
  void provide_entries(SparseMatrix &matrix);

  /// Local column number in @p matrix of the global unknown @p index; -1 if this rank has no such column.
  int local_column(const SparseMatrix &matrix, dealii::types::global_dof_index index);

  /// Local row number in @p matrix of the global unknown @p index; -1 if this rank does not own it.
  int local_row(const SparseMatrix &matrix, dealii::types::global_dof_index index);
} // namespace myolines
