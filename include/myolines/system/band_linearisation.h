// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/band_matrix.h>
#include <myolines/system/ledger.h>
#include <myolines/system/linearisation.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace myolines
{
  /// A linearisation whose matrices are narrow bands on one rank (one-dimensional bodies, a few unknowns). Newton's method
  /// then solves directly and without the set-up that large problems need.
  class BandLinearisation : public Linearisation
  {
  public:
    virtual unsigned int bandwidth() const = 0; ///< of the wider of both sides

    /// As sparse(), into @p matrix of this bandwidth.
    virtual void fill(const WeightsByOrder &weights, BandMatrix &matrix) const = 0;

    /// Changes with every linearise(): equal versions, equal matrices for equal weights.
    virtual std::uint64_t version() const = 0;
  };

  /// One that stores K, C and a constant M, row by row: entry (i, j) at (2 k + 1) i + k + j - i with the bandwidth k. Columns take the
  /// weights of the order of their unknown.
  class StoredBands : public BandLinearisation
  {
  public:
    /// @p orders of the unknowns in time; @p fixed: numbers of the prescribed ones, ascending, which depend on no others.
    StoredBands(std::vector<unsigned int> orders, unsigned int bandwidth, const std::vector<unsigned int> &fixed, WorkLedger &ledger);

    double &stiffness(const unsigned int i, const unsigned int j) { return entries_[position(i, j)].u; } ///< entry of K
    double &damping(const unsigned int i, const unsigned int j) { return entries_[position(i, j)].v; }   ///< entry of C
    double &mass(const unsigned int i, const unsigned int j) { return entries_[position(i, j)].a; }      ///< entry of M

    /// K and C all zero, for a new sum over elements; M is summed only once, the first time.
    void begin();
    bool has_mass() const { return version_ > 1; } ///< whether there is any mass

    unsigned int        bandwidth() const override { return bandwidth_; }
    void                fill(const WeightsByOrder &weights, BandMatrix &matrix) const override;
    std::uint64_t       version() const override { return version_; }
    void                apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const override;
    const SparseMatrix &sparse(const WeightsByOrder &weights) override;

  private:
    unsigned int size() const { return orders_.size(); }
    std::size_t  position(const unsigned int i, const unsigned int j) const { return (2 * bandwidth_ + 1) * i + bandwidth_ + j - i; }
    unsigned int first(const unsigned int i) const { return i < bandwidth_ ? 0 : i - bandwidth_; }
    unsigned int last(const unsigned int i) const { return std::min(size(), i + bandwidth_ + 1); }
    double       value(const WeightsByOrder &weights, const unsigned int i, const unsigned int j) const
    {
      const Weights &w = weights[orders_[j]], &e = entries_[position(i, j)];
      return w.u * e.u + w.v * e.v + w.a * e.a;
    }

    /// Calls set(i, j, value) for the entries of the matrix, with unit rows, times a typical entry, for the fixed ones.
    template <typename Set>
    void each_entry(const WeightsByOrder &weights, const Set &set) const;

    const std::vector<unsigned int> orders_;
    const unsigned int              bandwidth_;
    std::vector<bool>               fixed_;
    unsigned int                    typical_; ///< the first free unknown, or the last of all if none is
    WorkLedger                     &ledger_;
    std::vector<Weights>            entries_; ///< of K, C and M
    std::uint64_t                   version_ = 0;
    SparseMatrix                    matrix_; ///< made when asked for
    std::uint64_t                   version_of_matrix_ = 0;
    WeightsByOrder                  weights_of_matrix_{};
  };
} // namespace myolines
