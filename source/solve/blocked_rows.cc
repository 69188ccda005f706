// SPDX-License-Identifier: LGPL-2.1-or-later
#include "blocked_rows.h"

#include <Epetra_Import.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <cstring>
#include <unordered_map>
#include <utility>

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

    /// Puts the entries of a row into the order of their global columns, in which those of a node stand together. Among columns of other
    /// ranks Epetra has an order of its own. False if they do not come in threes.
    bool sort_by_node(const Epetra_CrsMatrix &matrix, const Rows &rows, const int row, std::vector<std::pair<long long, int>> &entries)
    {
      entries.clear();
      for (int k = rows.start[row]; k < rows.start[row + 1]; ++k)
        entries.emplace_back(matrix.ColMap().GID64(rows.columns[k]), k - rows.start[row]);
      std::sort(entries.begin(), entries.end());
      for (std::size_t k = 0; k < entries.size(); ++k)
        if (entries[k].first % 3 != static_cast<long long>(k % 3) ||
            entries[k].first != entries[k - k % 3].first + static_cast<long long>(k % 3))
          return false;
      return entries.size() % 3 == 0;
    }

    bool come_in_threes(const Epetra_CrsMatrix &matrix)
    {
      const Rows rows(matrix);
      if (rows.start == nullptr || rows.n % 3 != 0)
        return false;
      std::vector<std::pair<long long, int>> entries;
      for (int row = 0; row < rows.n; row += 3)
        {
          const int *first = rows.columns + rows.start[row], n = rows.start[row + 1] - rows.start[row];
          for (int c = 1; c < 3; ++c)
            if (rows.start[row + c + 1] - rows.start[row + c] != n || !std::equal(first, first + n, rows.columns + rows.start[row + c]))
              return false;
          if (!sort_by_node(matrix, rows, row, entries))
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
    int here = come_in_threes(matrix), everywhere = 0;
    matrix.Comm().MinAll(&here, &everywhere, 1);
    return everywhere == 1;
  }

  BlockedRows::BlockedRows(const Epetra_CrsMatrix &matrix)
    : Epetra_BasicRowMatrix(matrix.Comm())
    , matrix_(matrix)
  {
    SetMaps(matrix.RowMap(), matrix.ColMap(), matrix.DomainMap(), matrix.RangeMap());
    const Rows                                  rows(matrix);
    std::vector<std::pair<long long, int>>      entries;
    std::unordered_map<long long, unsigned int> numbers; // of the nodes of columns
    row_start_.push_back(0);
    for (int row = 0; row < rows.n; row += 3)
      row_start_.push_back(row_start_.back() + (rows.start[row + 1] - rows.start[row]) / 3);
    columns_.resize(row_start_.back());
    blocks_.resize(9 * std::size_t(row_start_.back()) + 1);
    for (std::size_t node = 0; node + 1 < row_start_.size(); ++node)
      {
        sort_by_node(matrix, rows, 3 * node, entries);
        for (unsigned int k = row_start_[node]; k < row_start_[node + 1]; ++k)
          {
            const auto *three          = &entries[3 * (k - row_start_[node])];
            const auto [number, fresh] = numbers.emplace(three->first, static_cast<unsigned int>(places_.size()));
            columns_[k]                = number->second;
            for (int c = 0; c < 3; ++c)
              {
                if (fresh)
                  places_.push_back(rows.columns[rows.start[3 * node] + three[c].second]);
                for (int a = 0; a < 3; ++a)
                  blocks_[9 * std::size_t(k) + 3 * c + a] = static_cast<float>(rows.values[rows.start[3 * node + a] + three[c].second]);
              }
          }
      }
    x_.resize(places_.size());
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
          x_[i] = static_cast<float>(x[places_[i]]);
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
    return columns_.memory() + blocks_.memory() + row_start_.size() * sizeof(unsigned int) + x_.size() * (sizeof(float) + sizeof(int));
  }
} // namespace myolines
