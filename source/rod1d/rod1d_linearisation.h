#pragma once

#include <myolines/system/band_linearisation.h>
#include <myolines/system/ledger.h>

namespace myolines
{
  /// K and M of a rod as bands, row by row: entry (i, j) at (2 k + 1) i + k + j - i with the bandwidth k.
  class Rod1dLinearisation : public BandLinearisation
  {
  public:
    Rod1dLinearisation(unsigned int size, unsigned int bandwidth, WorkLedger &ledger);

    double &stiffness(const unsigned int i, const unsigned int j) { return stiffness_[position(i, j)]; }
    double &mass(const unsigned int i, const unsigned int j) { return mass_[position(i, j)]; }

    /// All zero, for a new sum over elements; the mass only once.
    void begin();
    bool has_mass() const { return version_ > 1; }

    unsigned int        bandwidth() const override { return bandwidth_; }
    void                fill(const WeightsByOrder &weights, BandMatrix &matrix) const override;
    std::uint64_t       version() const override { return version_; }
    void                apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const override;
    const SparseMatrix &sparse(const WeightsByOrder &weights) override;

  private:
    std::size_t  position(const unsigned int i, const unsigned int j) const { return (2 * bandwidth_ + 1) * i + bandwidth_ + j - i; }
    unsigned int first(const unsigned int i) const { return i < bandwidth_ ? 0 : i - bandwidth_; }
    unsigned int last(const unsigned int i) const { return std::min(size_, i + bandwidth_ + 1); }

    /// Calls set(i, j, value) for the entries of the matrix with unit rows, times a typical one, at both ends.
    template <typename Set>
    void each_entry(const Weights &w, const Set &set) const;

    const unsigned int  size_;
    const unsigned int  bandwidth_;
    WorkLedger         &ledger_;
    std::vector<double> stiffness_, mass_;
    std::uint64_t       version_ = 0;
    SparseMatrix        matrix_; ///< made when asked for
  };
} // namespace myolines
