// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/sparse_matrix.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    constexpr unsigned int n = 5;

    /// Sets the entries of a tridiagonal matrix to @p scale i + j, and reads them back.
    void expect_written(SparseMatrix &matrix, const double scale)
    {
      const CompressedRows rows = compressed_rows(matrix);
      for (unsigned int i = 0; i < n; ++i)
        {
          const int row = local_row(matrix, i);
          for (int k = rows.row_start[row]; k < rows.row_start[row + 1]; ++k)
            for (unsigned int j = 0; j < n; ++j)
              if (rows.columns[k] == local_column(matrix, j))
                rows.values[k] = scale * i + j;
        }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          EXPECT_EQ(matrix.el(i, j), i + 1 >= j && j + 1 >= i ? scale * i + j : 0.);
    }

    TEST(CompressedRows, WriteTheEntriesTheyName)
    {
      dealii::DynamicSparsityPattern pattern(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = (i > 0 ? i - 1 : 0); j < std::min(n, i + 2); ++j)
          pattern.add(i, j);
      SparseMatrix matrix;
      matrix.reinit(pattern);
      expect_written(matrix, 10);

      release_entries(matrix);
      release_entries(matrix); // nothing is left to be released
      EXPECT_EQ(compressed_rows(matrix).values, nullptr);
      provide_entries(matrix);
      expect_written(matrix, 100);
      provide_entries(matrix);
      EXPECT_EQ(matrix.el(1, 2), 102.) << "entries that are there stay";
    }
  } // namespace
} // namespace myolines
