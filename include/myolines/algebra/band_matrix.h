// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

namespace myolines
{
  /// Square matrix with entries only where |i - j| <= bandwidth, on one rank, and its LU factors (LAPACK dgbtrf, dgbtrs).
  class BandMatrix
  {
  public:
    BandMatrix(unsigned int size, unsigned int bandwidth); ///< Zero.

    unsigned int size() const { return size_; }           ///< Number of rows, which is that of columns.
    unsigned int bandwidth() const { return bandwidth_; } ///< Largest |i - j| that has an entry.

    /// All entries zero, and no factors any more.
    void clear();

    /// Entry (i, j) inside the band.
    double &operator()(const unsigned int i, const unsigned int j)
    {
      return entries_[2 * bandwidth_ + i - j + static_cast<std::size_t>(j) * leading_];
    }

    /// Overwrites the entries by the factors. False if a pivot is zero or not a number.
    bool factorise();

    /// x <- A^-1 x for the @p x of size() entries; after a successful factorise().
    void solve(double *x) const;

  private:
    unsigned int        size_;
    unsigned int        bandwidth_;
    unsigned int        leading_; ///< of the columns: row exchanges need room for bandwidth more diagonals above
    std::vector<double> entries_;
    std::vector<int>    pivots_;
  };
} // namespace myolines
