#pragma once

#include <myolines/system/band_linearisation.h>
#include <myolines/system/ledger.h>

#include <vector>

namespace myolines
{
  /// K, C and M of a system without constraints as bands, row by row: entry (i, j) at (2 k + 1) i + k + j - i with the bandwidth k.
  /// Columns take the weights of the order of their unknown.
  class Muscle1dLinearisation : public BandLinearisation
  {
  public:
    /// @p orders of the unknowns, 1 or 2.
    Muscle1dLinearisation(std::vector<unsigned int> orders, unsigned int bandwidth, WorkLedger &ledger);

    double &stiffness(const unsigned int i, const unsigned int j) { return entries_[position(i, j)].u; }
    double &damping(const unsigned int i, const unsigned int j) { return entries_[position(i, j)].v; }
    double &mass(const unsigned int i, const unsigned int j) { return entries_[position(i, j)].a; }

    /// All zero, for a new sum over elements.
    void begin();

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

    const std::vector<unsigned int> orders_;
    const unsigned int              bandwidth_;
    WorkLedger                     &ledger_;
    std::vector<Weights>            entries_; ///< of K, C and M
    std::uint64_t                   version_ = 0;
    SparseMatrix                    matrix_; ///< made when asked for
  };
} // namespace myolines
