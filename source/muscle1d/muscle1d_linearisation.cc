#include "muscle1d_linearisation.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>

namespace myolines
{
  Muscle1dLinearisation::Muscle1dLinearisation(std::vector<unsigned int> orders, const unsigned int bandwidth, WorkLedger &ledger)
    : orders_(std::move(orders))
    , bandwidth_(bandwidth)
    , ledger_(ledger)
    , entries_((2 * bandwidth + 1) * orders_.size())
  {}

  void Muscle1dLinearisation::begin()
  {
    std::fill(entries_.begin(), entries_.end(), Weights{});
    ++version_;
  }

  void Muscle1dLinearisation::fill(const WeightsByOrder &weights, BandMatrix &matrix) const
  {
    ledger_.count("jacobian assemblies");
    matrix.clear();
    for (unsigned int i = 0; i < size(); ++i)
      for (unsigned int j = first(i); j < last(i); ++j)
        matrix(i, j) = value(weights, i, j);
  }

  void Muscle1dLinearisation::apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const
  {
    for (unsigned int i = 0; i < size(); ++i)
      {
        double sum = 0;
        for (unsigned int j = first(i); j < last(i); ++j)
          sum += value(weights, i, j) * x.local_element(j);
        y.local_element(i) = sum;
      }
  }

  const SparseMatrix &Muscle1dLinearisation::sparse(const WeightsByOrder &weights)
  {
    ledger_.count("jacobian assemblies");
    if (matrix_.m() != size())
      {
        dealii::DynamicSparsityPattern pattern(size(), size());
        for (unsigned int i = 0; i < size(); ++i)
          for (unsigned int j = first(i); j < last(i); ++j)
            pattern.add(i, j);
        matrix_.reinit(dealii::complete_index_set(size()), pattern, MPI_COMM_SELF);
      }
    for (unsigned int i = 0; i < size(); ++i)
      for (unsigned int j = first(i); j < last(i); ++j)
        matrix_.set(i, j, value(weights, i, j));
    matrix_.compress(dealii::VectorOperation::insert);
    return matrix_;
  }
} // namespace myolines
