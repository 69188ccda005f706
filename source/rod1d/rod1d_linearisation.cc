#include "rod1d_linearisation.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>

namespace myolines
{
  Rod1dLinearisation::Rod1dLinearisation(const unsigned int size, const unsigned int bandwidth, WorkLedger &ledger)
    : size_(size)
    , bandwidth_(bandwidth)
    , ledger_(ledger)
    , stiffness_((2 * bandwidth + 1) * size)
    , mass_((2 * bandwidth + 1) * size)
  {}

  void Rod1dLinearisation::begin()
  {
    std::fill(stiffness_.begin(), stiffness_.end(), 0.);
    ++version_;
  }

  template <typename Set>
  void Rod1dLinearisation::each_entry(const Weights &w, const Set &set) const
  {
    const auto value = [&](const unsigned int i, const unsigned int j) {
      return w.u * stiffness_[position(i, j)] + w.a * mass_[position(i, j)];
    };
    const double typical = value(1, 1);
    for (unsigned int i = 0; i < size_; ++i)
      for (unsigned int j = first(i); j < last(i); ++j)
        {
          const bool constrained = i == 0 || i + 1 == size_ || j == 0 || j + 1 == size_;
          set(i, j, !constrained ? value(i, j) : i == j ? typical : 0.);
        }
  }

  void Rod1dLinearisation::fill(const WeightsByOrder &weights, BandMatrix &matrix) const
  {
    ledger_.count("jacobian assemblies");
    matrix.clear();
    each_entry(weights[2], [&](const unsigned int i, const unsigned int j, const double value) { matrix(i, j) = value; });
  }

  void Rod1dLinearisation::apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const
  {
    const Weights &w = weights[2];
    for (unsigned int i = 0; i < size_; ++i)
      {
        double sum = 0;
        for (unsigned int j = first(i); j < last(i); ++j)
          sum += (w.u * stiffness_[position(i, j)] + w.a * mass_[position(i, j)]) * x.local_element(j);
        y.local_element(i) = sum;
      }
  }

  const SparseMatrix &Rod1dLinearisation::sparse(const WeightsByOrder &weights)
  {
    ledger_.count("jacobian assemblies");
    if (matrix_.m() != size_)
      {
        dealii::DynamicSparsityPattern pattern(size_, size_);
        for (unsigned int i = 0; i < size_; ++i)
          for (unsigned int j = first(i); j < last(i); ++j)
            pattern.add(i, j);
        matrix_.reinit(dealii::complete_index_set(size_), pattern, MPI_COMM_SELF);
      }
    each_entry(weights[2], [&](const unsigned int i, const unsigned int j, const double value) { matrix_.set(i, j, value); });
    matrix_.compress(dealii::VectorOperation::insert);
    return matrix_;
  }
} // namespace myolines
