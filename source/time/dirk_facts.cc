// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/dirk_facts.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    using Column = std::vector<double>;

    /// A x, the rows of A being as long as they are.
    Column product(const DirkTable &table, const Column &x)
    {
      Column y(x.size());
      for (std::size_t i = 0; i < y.size(); ++i)
        for (std::size_t j = 0; j < table.a[i].size(); ++j)
          y[i] += table.a[i][j] * x[j];
      return y;
    }

    Column times(const Column &x, const Column &y)
    {
      Column z(x);
      for (std::size_t i = 0; i < z.size(); ++i)
        z[i] *= y[i];
      return z;
    }

    double dot(const Column &x, const Column &y)
    {
      double sum = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        sum += x[i] * y[i];
      return sum;
    }

    constexpr double table_rounding = 1e-10; ///< of coefficients given with a dozen digits

    bool equal(const double x, const double y) { return std::abs(x - y) < table_rounding; }

    /// Highest order whose conditions the weights @p b meet, up to 4.
    unsigned int order_of(const DirkTable &table, const Column &b)
    {
      const Column one(b.size(), 1.), c = product(table, one), Ac = product(table, c), cc = times(c, c);
      if (!equal(dot(b, one), 1))
        return 0;
      if (!equal(dot(b, c), 1. / 2))
        return 1;
      if (!equal(dot(b, cc), 1. / 3) || !equal(dot(b, Ac), 1. / 6))
        return 2;
      const bool fourth = equal(dot(b, times(c, cc)), 1. / 4) && equal(dot(b, times(c, Ac)), 1. / 8) &&
                          equal(dot(b, product(table, cc)), 1. / 12) && equal(dot(b, product(table, Ac)), 1. / 24);
      return fourth ? 4 : 3;
    }

    /// Largest q up to 4 with sum_j a_ij c_j^(q-1) = c_i^q / q for all stages.
    unsigned int stage_order(const DirkTable &table)
    {
      const Column one(table.a.size(), 1.), c = product(table, one);
      Column       power = one; // c^(q - 1)
      for (unsigned int q = 1; q <= 4; ++q)
        {
          const Column integral = product(table, power);
          power                 = times(power, c);
          for (std::size_t i = 0; i < c.size(); ++i)
            if (!equal(integral[i], power[i] / q))
              return q - 1;
        }
      return 4;
    }

    /// |R| at infinity: stages after an explicit first one tend to -(sum_j<i a_ij Y_j)/a_ii, those after an implicit one vanish.
    double at_infinity(const DirkTable &table)
    {
      Column stages(table.a.size());
      for (std::size_t i = 0; i < stages.size(); ++i)
        {
          stages[i] = i == 0 && table.explicit_first_stage() ? 1 : 0;
          for (std::size_t j = 0; j < i; ++j)
            stages[i] -= table.a[i][j] * stages[j] / table.a[i][i];
        }
      return std::abs(stages.back());
    }

    bool is_bounded_on_the_imaginary_axis(const DirkTable &table)
    {
      constexpr double first = -4, last = 6, step = 0.005; // of the logarithm of y
      for (double exponent = first; exponent <= last; exponent += step)
        if (std::abs(stability_function(table, {0, std::pow(10, exponent)})) > 1 + table_rounding)
          return false;
      return true;
    }
  } // namespace

  std::complex<double> stability_function(const DirkTable &table, const std::complex<double> z)
  {
    std::vector<std::complex<double>> stages;
    for (const std::vector<double> &row : table.a)
      {
        std::complex<double> sum = 1;
        for (std::size_t j = 0; j < stages.size(); ++j)
          sum += z * row[j] * stages[j];
        stages.push_back(sum / (1. - z * row.back()));
      }
    return stages.back();
  }

  DirkFacts facts_of(const DirkTable &table)
  {
    DirkFacts     facts;
    const Column &b   = table.a.back();
    facts.order       = order_of(table, b);
    facts.stage_order = stage_order(table);
    facts.at_infinity = at_infinity(table);
    facts.a_stable    = facts.at_infinity <= 1 + table_rounding && is_bounded_on_the_imaginary_axis(table);
    if (!table.error.empty())
      {
        Column embedded(b);
        for (std::size_t i = 0; i < b.size(); ++i)
          embedded[i] -= table.error[i];
        facts.embedded_order = order_of(table, embedded);
      }
    return facts;
  }

  std::vector<std::string> tell(const DirkFacts &facts)
  {
    std::ostringstream orders, stability;
    orders << "order " << facts.order << " (conditions up to order 4 are looked at), stages of order " << facts.stage_order << ", "
           << (facts.embedded_order > 0 ? "embedded formula of order " + std::to_string(facts.embedded_order) : "no embedded formula");
    stability << "stiffly accurate, "
              << (facts.l_stable() ? "L-stable"
                  : facts.a_stable ? "A-stable"
                                   : "not A-stable")
              << ", spectral radius at infinity " << (facts.at_infinity < table_rounding ? 0 : facts.at_infinity);
    return {orders.str(), stability.str()};
  }
} // namespace myolines
