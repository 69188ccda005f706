// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/sparse_matrix.h>

#include <Epetra_CrsMatrix.h>

namespace myolines
{
  namespace
  {
    Epetra_CrsMatrix &rows_of(SparseMatrix &matrix) { return const_cast<Epetra_CrsMatrix &>(matrix.trilinos_matrix()); }
  } // namespace

  CompressedRows compressed_rows(SparseMatrix &matrix)
  {
    Epetra_CrsMatrix &crs       = rows_of(matrix);
    int              *row_start = nullptr;
    int              *columns   = nullptr;
    double           *values    = nullptr;
    const int         ierr      = crs.ExtractCrsDataPointers(row_start, columns, values);
    AssertThrow(ierr == 0, dealii::ExcMessage("the sparse matrix is not in compressed storage"));
    return {row_start, columns, values};
  }

  // Epetra allocates the values of compressed rows as one array of double by new[], and deletes them so.

  void release_entries(SparseMatrix &matrix)
  {
    double *&values = rows_of(matrix).ExpertExtractValues();
    delete[] values;
    values = nullptr;
  }

  void provide_entries(SparseMatrix &matrix)
  {
    double *&values = rows_of(matrix).ExpertExtractValues();
    if (values == nullptr)
      values = new double[matrix.trilinos_matrix().NumMyNonzeros()];
  }

  int local_column(const SparseMatrix &matrix, const dealii::types::global_dof_index index)
  {
    return matrix.trilinos_matrix().LCID(static_cast<int>(index));
  }

  int local_row(const SparseMatrix &matrix, const dealii::types::global_dof_index index)
  {
    return matrix.trilinos_matrix().LRID(static_cast<int>(index));
  }
} // namespace myolines
