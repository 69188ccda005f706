// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// Private to this room.

#include <myolines/base/large_array.h>

#include <Epetra_BasicRowMatrix.h>
#include <Epetra_CrsMatrix.h>

#include <vector>

namespace myolines
{
  /// The rows of a matrix whose unknowns come in threes, as ML sees them: entries are those of the matrix, products are made with a copy
  /// of 3 x 3 blocks in single precision, 40 bytes a block where compressed rows take 108. Products are what a cycle of ML streams; the
  /// entries are read by set-ups of ML alone, and may then be released.
  class BlockedRows : public Epetra_BasicRowMatrix
  {
  public:
    /// Whether rows and columns of @p matrix come in threes, on all ranks. Collective.
    static bool suits(const Epetra_CrsMatrix &matrix);

    /// Of a matrix that suits, whose pattern outlives this.
    explicit BlockedRows(const Epetra_CrsMatrix &matrix);

    int Multiply(bool transposed, const Epetra_MultiVector &X, Epetra_MultiVector &Y) const override;

    int ExtractMyRowCopy(int row, int length, int &n_entries, double *values, int *indices) const override
    {
      return matrix_.ExtractMyRowCopy(row, length, n_entries, values, indices);
    }
    int ExtractMyEntryView(int entry, double *&value, int &row, int &column) override;
    int ExtractMyEntryView(int entry, const double *&value, int &row, int &column) const override;
    int NumMyRowEntries(int row, int &n_entries) const override { return matrix_.NumMyRowEntries(row, n_entries); }

    std::size_t memory() const; ///< bytes of the copy

  private:
    const Epetra_CrsMatrix    &matrix_;
    std::vector<unsigned int>  row_start_; ///< of threes of rows
    LargeArray<unsigned int>   columns_;   ///< of each block: where its first column is in x_
    LargeArray<float>          blocks_;    ///< column by column
    std::vector<int>           places_;    ///< of the entries of x_ among the columns of the matrix, node by node
    mutable std::vector<float> x_;         ///< with what other ranks own
  };
} // namespace myolines
