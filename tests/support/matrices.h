// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/linearisation.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <functional>

namespace myolines::testing
{
  inline Vector serial_vector(const unsigned int size)
  {
    Vector x(dealii::complete_index_set(size), MPI_COMM_SELF);
    x.update_ghost_values();
    return x;
  }

  /// A linearisation K given entry by entry (weight u only), with constraints condensed by plain loops over dense entries.
  class DenseLinearisation : public Linearisation
  {
  public:
    using Entries = std::function<double(unsigned int, unsigned int)>;

    DenseLinearisation(const unsigned int size, Entries entries, const Constraints &constraints, const unsigned int bandwidth)
      : size_(size)
      , bandwidth_(bandwidth)
      , entries_(std::move(entries))
      , constraints_(constraints)
    {}

    void set(Entries entries) { entries_ = std::move(entries); }

    void apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const override
    {
      for (unsigned int i = 0; i < size_; ++i)
        {
          double sum = 0;
          for (unsigned int j = first(i); j < last(i); ++j)
            sum += entries_(i, j) * x.local_element(j);
          y.local_element(i) = weights[2].u * sum;
        }
    }

    /// C^T K C, one entry after the other through the list of (free unknown, weight) that each unknown stands for.
    const SparseMatrix &sparse(const WeightsByOrder &weights) override
    {
      dealii::DynamicSparsityPattern                          pattern(size_, size_);
      std::map<std::pair<unsigned int, unsigned int>, double> values;
      for (unsigned int i = 0; i < size_; ++i)
        {
          values[{i, i}] += constraints_.is_constrained(i) ? 1. : 0.;
          for (unsigned int j = first(i); j < last(i); ++j)
            for (const auto &[row, row_weight] : stands_for(i))
              for (const auto &[column, column_weight] : stands_for(j))
                values[{row, column}] += weights[2].u * row_weight * column_weight * entries_(i, j);
        }
      for (const auto &[position, value] : values)
        pattern.add(position.first, position.second);
      if (matrix_.m() != size_)
        matrix_.reinit(dealii::complete_index_set(size_), pattern, MPI_COMM_SELF);
      for (const auto &[position, value] : values)
        matrix_.set(position.first, position.second, value);
      matrix_.compress(dealii::VectorOperation::insert);
      return matrix_;
    }

  private:
    unsigned int first(const unsigned int i) const { return i < bandwidth_ ? 0 : i - bandwidth_; }
    unsigned int last(const unsigned int i) const { return std::min(size_, i + bandwidth_ + 1); }

    std::vector<std::pair<unsigned int, double>> stands_for(const unsigned int i) const
    {
      if (!constraints_.is_constrained(i))
        return {{i, 1.}};
      std::vector<std::pair<unsigned int, double>> result;
      for (const auto &[index, weight] : *constraints_.get_constraint_entries(i))
        result.emplace_back(index, weight);
      return result;
    }

    unsigned int       size_;
    unsigned int       bandwidth_;
    Entries            entries_;
    const Constraints &constraints_;
    SparseMatrix       matrix_;
  };
} // namespace myolines::testing
