// SPDX-License-Identifier: LGPL-2.1-or-later
#include "blocked_rows.h"

#include <Epetra_Import.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <cstring>

namespace myolines
{
  namespace
  {
    struct Rows
    {
      explicit Rows(const Epetra_CrsMatrix &matrix)
        : n(matrix.NumMyRows())
      {
        if (matrix.ExtractCrsDataPointers(start, columns, values) != 0)
          start = nullptr; // not in compressed storage
      }
      int     n;
      int    *start = nullptr, *columns = nullptr;
      double *values = nullptr;
    };

    bool come_in_threes(const Rows &rows)
    {
      if (rows.start == nullptr || rows.n % 3 != 0)
        return false;
      for (int row = 0; row < rows.n; row += 3)
        {
          const int *first = rows.columns + rows.start[row], n = rows.start[row + 1] - rows.start[row];
          for (int k = 0; k < n; ++k)
            if (first[k] != first[k - k % 3] + k % 3)
              return false;
          for (int c = 1; c < 3; ++c)
            if (rows.start[row + c + 1] - rows.start[row + c] != n || !std::equal(first, first + n, rows.columns + rows.start[row + c]))
              return false;
          if (n % 3 != 0)
            return false;
        }
      return true;
    }

    typedef float Four __attribute__((vector_size(16))); // three, and one that is not used

    Four three(const float *from)
    {
      Four x;
      std::memcpy(&x, from, sizeof(x));
      return x;
    }
  } // namespace

  bool BlockedRows::suits(const Epetra_CrsMatrix &matrix)
  {
    int here = come_in_threes(Rows(matrix)), everywhere = 0;
    matrix.Comm().MinAll(&here, &everywhere, 1);
    return everywhere == 1;
  }

  BlockedRows::BlockedRows(const Epetra_CrsMatrix &matrix)
    : Epetra_BasicRowMatrix(matrix.Comm())
    , matrix_(matrix)
    , x_(matrix.NumMyCols())
  {
    SetMaps(matrix.RowMap(), matrix.ColMap(), matrix.DomainMap(), matrix.RangeMap());
    const Rows rows(matrix);
    row_start_.push_back(0);
    for (int row = 0; row < rows.n; row += 3)
      row_start_.push_back(row_start_.back() + (rows.start[row + 1] - rows.start[row]) / 3);
    columns_.resize(row_start_.back());
    blocks_.resize(9 * std::size_t(row_start_.back()) + 1);
    for (int node = 0; node + 1 < static_cast<int>(row_start_.size()); ++node)
      for (unsigned int k = row_start_[node]; k < row_start_[node + 1]; ++k)
        {
          const int at = 3 * (k - row_start_[node]);
          columns_[k]  = rows.columns[rows.start[3 * node] + at];
          for (int a = 0; a < 3; ++a)
            for (int c = 0; c < 3; ++c)
              blocks_[9 * std::size_t(k) + 3 * c + a] = static_cast<float>(rows.values[rows.start[3 * node + a] + at + c]);
        }
  }

  int BlockedRows::Multiply(const bool transposed, const Epetra_MultiVector &X, Epetra_MultiVector &Y) const
  {
    if (transposed)
      return matrix_.Multiply(true, X, Y);
    for (int vector = 0; vector < X.NumVectors(); ++vector)
      {
        const double *x = X[vector];
        Epetra_Vector ghosted(RowMatrixImporter() != nullptr ? RowMatrixColMap() : Epetra_Map(0, 0, 0, Comm()), false);
        if (RowMatrixImporter() != nullptr)
          {
            if (const int code = ghosted.Import(*X(vector), *RowMatrixImporter(), Insert); code != 0)
              return code;
            x = ghosted.Values();
          }
        for (std::size_t i = 0; i < x_.size(); ++i)
          x_[i] = static_cast<float>(x[i]);
        double *y = Y[vector];
        for (std::size_t node = 0; node + 1 < row_start_.size(); ++node)
          {
            Four sum{};
            for (unsigned int k = row_start_[node]; k < row_start_[node + 1]; ++k)
              {
                const float *block = blocks_.data() + 9 * std::size_t(k), *at = x_.data() + columns_[k];
                sum += three(block) * at[0] + three(block + 3) * at[1] + three(block + 6) * at[2];
              }
            for (int a = 0; a < 3; ++a)
              y[3 * node + a] = sum[a];
          }
      }
    return 0;
  }

  int BlockedRows::ExtractMyEntryView(const int entry, double *&value, int &row, int &column)
  {
    const Rows rows(matrix_);
    row    = static_cast<int>(std::upper_bound(rows.start, rows.start + rows.n + 1, entry) - rows.start) - 1;
    column = rows.columns[entry];
    value  = rows.values + entry;
    return 0;
  }

  int BlockedRows::ExtractMyEntryView(const int entry, const double *&value, int &row, int &column) const
  {
    double *at = nullptr;
    const_cast<BlockedRows *>(this)->ExtractMyEntryView(entry, at, row, column);
    value = at;
    return 0;
  }

  std::size_t BlockedRows::memory() const
  {
    return columns_.memory() + blocks_.memory() + row_start_.size() * sizeof(unsigned int) + x_.size() * sizeof(float);
  }
} // namespace myolines
