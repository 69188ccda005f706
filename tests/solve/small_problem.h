// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/matrices.h"
#include "../support/solvers.h"

#include <functional>
#include <map>
#include <numeric>

namespace myolines::testing
{
  using Values = std::vector<double>;

  /// A small problem from plain functions of plain numbers; inadmissible where f returns NaN.
  class SmallProblem : public NonlinearProblem
  {
  public:
    std::function<Values(const Values &)>              f;
    std::function<std::vector<Values>(const Values &)> jacobian;
    std::map<unsigned int, double>                     targets; ///< g of constrained unknowns
    Constraints                                        relations;
    std::vector<double>                                norms; ///< |f| of every evaluation

    explicit SmallProblem(const unsigned int size)
      : size_(size)
      , matrix_(
            size, [](unsigned int, unsigned int) { return 0.; }, relations, size)
    {}

    const Constraints &constraints() const override { return relations; }

    void impose(Vector &x) const override
    {
      for (const auto &[row, value] : targets)
        {
          x(row) = value;
          for (const auto &[index, weight] : *relations.get_constraint_entries(row))
            x(row) += weight * x(index);
        }
    }

    Evaluation residual(const Vector &x, Vector &r) override
    {
      const Values values = f(Values(x.begin(), x.end()));
      std::copy(values.begin(), values.end(), r.begin());
      norms.push_back(std::sqrt(std::inner_product(r.begin(), r.end(), r.begin(), 0.))); // r may be NaN, which l2_norm() asserts against
      return std::isfinite(norms.back()) ? Evaluation{} : Evaluation{false, "outside of the domain"};
    }

    void linearise(const Vector &x) override
    {
      const auto entries = jacobian(Values(x.begin(), x.end()));
      matrix_.set([entries](const unsigned int i, const unsigned int j) { return entries[i][j]; });
    }

    Linearisation        &linearisation() override { return matrix_; }
    const WeightsByOrder &weights() const override { return weights_; }
    bool                  symmetric() const override { return false; }

    Vector start(const Values &values) const
    {
      Vector x = serial_vector(size_);
      std::copy(values.begin(), values.end(), x.begin());
      return x;
    }

  private:
    unsigned int       size_;
    DenseLinearisation matrix_;
    WeightsByOrder     weights_ = stage_weights(1, 0, 0);
  };
} // namespace myolines::testing
