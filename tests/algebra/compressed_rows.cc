// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/sparse_matrix.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    TEST(CompressedRows, WriteTheEntriesTheyName)
    {
      const unsigned int             n = 5;
      dealii::DynamicSparsityPattern pattern(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = (i > 0 ? i - 1 : 0); j < std::min(n, i + 2); ++j)
          pattern.add(i, j);
      SparseMatrix matrix;
      matrix.reinit(pattern);
      const CompressedRows rows = compressed_rows(matrix);
      for (unsigned int i = 0; i < n; ++i)
        {
          const int row = local_row(matrix, i);
          for (int k = rows.row_start[row]; k < rows.row_start[row + 1]; ++k)
            for (unsigned int j = 0; j < n; ++j)
              if (rows.columns[k] == local_column(matrix, j))
                rows.values[k] = 10. * i + j;
        }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          EXPECT_EQ(matrix.el(i, j), i + 1 >= j && j + 1 >= i ? 10. * i + j : 0.);
    }
  } // namespace
} // namespace myolines
