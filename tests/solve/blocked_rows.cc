// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../../source/solve/blocked_rows.h"

#include <myolines/algebra/sparse_matrix.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_Vector.h>
#include <gtest/gtest.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    /// Unknown n / size a node, nodes coupled to those beside them and some far away; rows spread evenly over the ranks.
    SparseMatrix rows_of_nodes(const unsigned int n, const unsigned int size)
    {
      const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                         rank  = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      const unsigned int nodes = n / size, begin = nodes * rank / ranks * size, end = nodes * (rank + 1) / ranks * size;
      dealii::IndexSet   own(n);
      own.add_range(begin, end);
      dealii::DynamicSparsityPattern pattern(n, n, own);
      const auto                     coupled = [&](const unsigned int i, const unsigned int j) {
        const unsigned int a = i / size, b = j / size;
        return a == b || a + 1 == b || b + 1 == a || (a * b) % 7 == 3;
      };
      for (unsigned int i = begin; i < end; ++i)
        for (unsigned int j = 0; j < n; ++j)
          if (coupled(i, j))
            pattern.add(i, j);
      SparseMatrix matrix;
      matrix.reinit(own, own, pattern, MPI_COMM_WORLD, true);
      for (unsigned int i = begin; i < end; ++i)
        for (unsigned int j = 0; j < n; ++j)
          if (coupled(i, j))
            matrix.set(i, j, std::sin(1. + 3. * i + 5. * j));
      matrix.compress(dealii::VectorOperation::insert);
      return matrix;
    }

    TEST(BlockedRows, MultiplyLikeTheMatrix)
    {
      const SparseMatrix      matrix = rows_of_nodes(60, 3);
      const Epetra_CrsMatrix &rows   = matrix.trilinos_matrix();
      ASSERT_TRUE(BlockedRows::suits(rows));
      const BlockedRows blocked(rows);
      Epetra_Vector     x(rows.DomainMap()), y(rows.RangeMap()), expected(rows.RangeMap());
      for (int i = 0; i < x.MyLength(); ++i)
        x[i] = std::cos(2. + x.Map().GID(i));
      for (const bool transposed : {false, true})
        {
          rows.Multiply(transposed, x, expected);
          ASSERT_EQ(blocked.Multiply(transposed, x, y), 0);
          double size = 0, difference = 0;
          expected.NormInf(&size);
          y.Update(-1, expected, 1);
          y.NormInf(&difference);
          EXPECT_LT(difference, 2e-6 * size);
        }
    }

    TEST(BlockedRows, ShowTheEntriesOfTheMatrix)
    {
      const SparseMatrix      matrix = rows_of_nodes(30, 3);
      const Epetra_CrsMatrix &rows   = matrix.trilinos_matrix();
      ASSERT_TRUE(BlockedRows::suits(rows));
      const BlockedRows blocked(rows);
      EXPECT_EQ(blocked.NumMyNonzeros(), rows.NumMyNonzeros());
      int number = 0;
      for (int row = 0; row < rows.NumMyRows(); ++row)
        {
          int     n = 0, n_seen = 0, *columns = nullptr;
          double *values = nullptr;
          rows.ExtractMyRowView(row, n, values, columns);
          std::vector<double> seen(n);
          std::vector<int>    places(n);
          ASSERT_EQ(blocked.ExtractMyRowCopy(row, n, n_seen, seen.data(), places.data()), 0);
          EXPECT_EQ(seen, std::vector<double>(values, values + n));
          for (int k = 0; k < n; ++k, ++number)
            {
              const double *value = nullptr;
              int           at = -1, column = -1;
              blocked.ExtractMyEntryView(number, value, at, column);
              EXPECT_EQ(at, row);
              EXPECT_EQ(column, columns[k]);
              EXPECT_EQ(*value, values[k]);
            }
        }
    }

    TEST(BlockedRows, SuitOnlyUnknownsInThrees)
    {
      EXPECT_TRUE(BlockedRows::suits(rows_of_nodes(30, 3).trilinos_matrix()));
      EXPECT_FALSE(BlockedRows::suits(rows_of_nodes(30, 1).trilinos_matrix()));
      EXPECT_FALSE(BlockedRows::suits(rows_of_nodes(30, 2).trilinos_matrix()));
    }
  } // namespace
} // namespace myolines
