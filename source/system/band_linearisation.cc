// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/band_linearisation.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

namespace myolines
{
  namespace
  {
    bool equal(const WeightsByOrder &a, const WeightsByOrder &b)
    {
      return std::equal(a.begin(), a.end(), b.begin(),
                        [](const Weights &x, const Weights &y) { return x.u == y.u && x.v == y.v && x.a == y.a; });
    }
  } // namespace

  StoredBands::StoredBands(std::vector<unsigned int> orders, const unsigned int bandwidth, const std::vector<unsigned int> &fixed,
                           WorkLedger &ledger)
    : orders_(std::move(orders))
    , bandwidth_(bandwidth)
    , fixed_(orders_.size(), false)
    , ledger_(ledger)
    , entries_((2 * bandwidth + 1) * orders_.size())
  {
    for (const unsigned int i : fixed)
      fixed_[i] = true;
    const unsigned int found = std::find(fixed_.begin(), fixed_.end(), false) - fixed_.begin();
    typical_                 = std::min(found, size() - 1);
  }

  void StoredBands::begin()
  {
    for (Weights &entry : entries_)
      entry.u = entry.v = 0;
    ++version_;
  }

  template <typename Set>
  void StoredBands::each_entry(const WeightsByOrder &weights, const Set &set) const
  {
    const double typical = value(weights, typical_, typical_);
    for (unsigned int i = 0; i < size(); ++i)
      for (unsigned int j = first(i); j < last(i); ++j)
        set(i, j, !(fixed_[i] || fixed_[j]) ? value(weights, i, j) : i == j ? typical : 0.);
  }

  void StoredBands::fill(const WeightsByOrder &weights, BandMatrix &matrix) const
  {
    ledger_.count("jacobian assemblies");
    matrix.clear();
    each_entry(weights, [&](const unsigned int i, const unsigned int j, const double value) { matrix(i, j) = value; });
  }

  void StoredBands::apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const
  {
    for (unsigned int i = 0; i < size(); ++i)
      {
        double sum = 0;
        for (unsigned int j = first(i); j < last(i); ++j)
          sum += value(weights, i, j) * x.local_element(j);
        y.local_element(i) = sum;
      }
  }

  const SparseMatrix &StoredBands::sparse(const WeightsByOrder &weights)
  {
    if (version_of_matrix_ == version_ && equal(weights_of_matrix_, weights))
      return matrix_;
    ledger_.count("jacobian assemblies");
    if (matrix_.m() != size())
      {
        dealii::DynamicSparsityPattern pattern(size(), size());
        for (unsigned int i = 0; i < size(); ++i)
          for (unsigned int j = first(i); j < last(i); ++j)
            pattern.add(i, j);
        matrix_.reinit(dealii::complete_index_set(size()), pattern, MPI_COMM_SELF);
      }
    each_entry(weights, [&](const unsigned int i, const unsigned int j, const double value) { matrix_.set(i, j, value); });
    matrix_.compress(dealii::VectorOperation::insert);
    version_of_matrix_ = version_;
    weights_of_matrix_ = weights;
    return matrix_;
  }
} // namespace myolines
