// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// Private to this room: the only header that knows NOX.

#include <myolines/algebra/vector.h>

#include <NOX_Abstract_Vector.H>

#include <cmath>
#include <random>

namespace myolines
{
  /// Our vector as NOX sees it. Inside, the plain name Vector is that of the base class.
  class NoxVector : public NOX::Abstract::Vector
  {
  public:
    explicit NoxVector(myolines::Vector vector)
      : values(std::move(vector))
    {}

    static const myolines::Vector &of(const NOX::Abstract::Vector &x) { return dynamic_cast<const NoxVector &>(x).values; }

    NOX::Abstract::Vector &init(const double value) override
    {
      return map([value](double) { return value; }, *this);
    }
    NOX::Abstract::Vector &abs(const NOX::Abstract::Vector &y) override
    {
      return map([](double e) { return std::abs(e); }, y);
    }
    NOX::Abstract::Vector &reciprocal(const NOX::Abstract::Vector &y) override
    {
      return map([](double e) { return 1 / e; }, y);
    }

    NOX::Abstract::Vector &random(const bool use_seed, const int seed) override
    {
      std::mt19937                           generator(use_seed ? seed : 1);
      std::uniform_real_distribution<double> uniform(-1, 1);
      return map([&](double) { return uniform(generator); }, *this);
    }

    NOX::Abstract::Vector &operator=(const NOX::Abstract::Vector &y) override
    {
      values = of(y);
      return *this;
    }

    NOX::Abstract::Vector &scale(const double factor) override
    {
      values *= factor;
      return *this;
    }

    NOX::Abstract::Vector &scale(const NOX::Abstract::Vector &factors) override
    {
      values.scale(of(factors));
      return *this;
    }

    NOX::Abstract::Vector &update(const double alpha, const NOX::Abstract::Vector &a, const double gamma) override
    {
      values.sadd(gamma, alpha, of(a));
      return *this;
    }

    NOX::Abstract::Vector &update(const double alpha, const NOX::Abstract::Vector &a, const double beta, const NOX::Abstract::Vector &b,
                                  const double gamma) override
    {
      values.sadd(gamma, alpha, of(a));
      values.add(beta, of(b));
      return *this;
    }

    Teuchos::RCP<NOX::Abstract::Vector> clone(NOX::CopyType) const override { return Teuchos::rcp(new NoxVector(values)); }

    double norm(const NormType type) const override
    {
      return type == TwoNorm ? values.l2_norm() : type == OneNorm ? values.l1_norm() : values.linfty_norm();
    }

    double norm(const NOX::Abstract::Vector &weights) const override
    {
      myolines::Vector weighted = values;
      weighted.scale(of(weights));
      return std::sqrt(weighted * values);
    }

    double         innerProduct(const NOX::Abstract::Vector &y) const override { return values * of(y); }
    NOX::size_type length() const override { return values.size(); }

    myolines::Vector values;

  private:
    template <typename Function>
    NOX::Abstract::Vector &map(const Function &function, const NOX::Abstract::Vector &y)
    {
      const myolines::Vector &from = of(y);
      for (unsigned int i = 0; i < values.locally_owned_size(); ++i)
        values.local_element(i) = function(from.local_element(i));
      if (values.has_ghost_elements())
        values.update_ghost_values();
      return *this;
    }
  };
} // namespace myolines
