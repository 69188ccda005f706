// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/files.h>
#include <myolines/output/matrix_market.h>

#include <sstream>
#include <stdexcept>

namespace myolines
{
  void write_matrix_market(const SparseMatrix &matrix, const Constraints &constraints, const std::filesystem::path &file)
  {
    if (matrix.local_range() != std::make_pair(decltype(matrix.m())(0), matrix.m()))
      throw std::logic_error("a matrix is written on one rank");
    std::ostringstream entries;
    entries.precision(17);
    std::size_t number = 0;
    for (SparseMatrix::size_type row = 0; row < matrix.m(); ++row)
      for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
        if (!constraints.is_constrained(row) && !constraints.is_constrained(entry->column()) && entry->value() != 0)
          {
            entries << row + 1 << " " << entry->column() + 1 << " " << entry->value() << "\n";
            ++number;
          }
    std::ostringstream head;
    head << "%%MatrixMarket matrix coordinate real general\n% rows and columns of constrained unknowns are empty\n"
         << matrix.m() << " " << matrix.n() << " " << number << "\n";
    write_file(file, head.str() + entries.str());
  }
} // namespace myolines
