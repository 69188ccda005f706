// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/time/butcher_table.h>
#include <myolines/time/dirk.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <sstream>
#include <tuple>

namespace myolines
{
  namespace
  {
    using Column     = std::vector<double>;
    using Polynomial = std::vector<double>; ///< coefficients of 1, z, z^2, ...

    /// A x, the rows of A being as long as they are.
    Column product(const ButcherTable &table, const Column &x)
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

    /// Of the weights @p b, in the order of their orders.
    std::vector<OrderCondition> conditions_of(const ButcherTable &table, const Column &b)
    {
      const Column                one(b.size(), 1.), c = product(table, one), Ac = product(table, c), cc = times(c, c);
      std::vector<OrderCondition> conditions;
      const auto                  add = [&](const unsigned int order, const char *quantity, const Column &x, const unsigned int one_over) {
        const double value = dot(b, x);
        conditions.push_back({order, quantity, value, one_over, equal(value, 1. / one_over)});
      };
      add(1, "sum b", one, 1);
      add(2, "b c", c, 2);
      add(3, "b c^2", cc, 3);
      add(3, "b A c", Ac, 6);
      add(4, "b c^3", times(c, cc), 4);
      add(4, "b c A c", times(c, Ac), 8);
      add(4, "b A c^2", product(table, cc), 12);
      add(4, "b A A c", product(table, Ac), 24);
      return conditions;
    }

    /// Highest order up to which all hold.
    unsigned int order_of(const std::vector<OrderCondition> &conditions)
    {
      unsigned int order = conditions.back().order;
      for (const OrderCondition &condition : conditions)
        if (!condition.holds)
          order = std::min(order, condition.order - 1);
      return order;
    }

    unsigned int stage_order(const ButcherTable &table)
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

    /// p (1 - g z).
    Polynomial times_factor(Polynomial p, const double g)
    {
      if (g == 0)
        return p;
      p.push_back(0);
      for (std::size_t k = p.size() - 1; k > 0; --k)
        p[k] -= g * p[k - 1];
      return p;
    }

    /// Adds x z p to @p sum.
    void add_shifted(Polynomial &sum, const double x, const Polynomial &p)
    {
      sum.resize(std::max(sum.size(), p.size() + 1));
      for (std::size_t k = 0; k < p.size(); ++k)
        sum[k + 1] += x * p[k];
    }

    /// Stages of u' = lambda u over one denominator, the product of all 1 - a_ii z so far, and the end of the step as one more stage,
    /// which is known, where the last one is not the end. Numerator and denominator of R(z).
    std::pair<Polynomial, Polynomial> stability_function(const ButcherTable &table, const bool stiffly_accurate)
    {
      std::vector<Polynomial> stages; // numerators
      Polynomial              denominator{1};
      const auto              add_stage = [&](const Column &weights, const double diagonal) {
        Polynomial sum = denominator;
        for (std::size_t j = 0; j < stages.size(); ++j)
          add_shifted(sum, weights[j], stages[j]);
        denominator = times_factor(denominator, diagonal);
        for (Polynomial &stage : stages)
          stage = times_factor(stage, diagonal);
        stages.push_back(sum);
      };
      for (const Column &row : table.a)
        add_stage(row, row.back());
      if (!stiffly_accurate)
        add_stage(table.b, 0);
      return {stages.back(), denominator};
    }

    /// Coefficients with which nothing cancels in stability_function(): sizes of the terms that add up to its coefficients.
    ButcherTable without_cancellation(ButcherTable table)
    {
      for (Column &row : table.a)
        for (std::size_t j = 0; j < row.size(); ++j)
          row[j] = j + 1 < row.size() ? std::abs(row[j]) : -std::abs(row[j]);
      for (double &weight : table.b)
        weight = std::abs(weight);
      return table;
    }

    void find_stability_function(const ButcherTable &table, ButcherFacts &facts)
    {
      std::tie(facts.numerator, facts.denominator) = stability_function(table, facts.stiffly_accurate);
      const Polynomial sizes                       = stability_function(without_cancellation(table), facts.stiffly_accurate).first;
      constexpr double rounding                    = 1e-13; // of coefficients that cancel
      while (std::abs(facts.numerator.back()) < rounding * sizes[facts.numerator.size() - 1])
        facts.numerator.pop_back();
    }

    double at_infinity(const ButcherFacts &facts)
    {
      if (facts.numerator.size() > facts.denominator.size())
        return std::numeric_limits<double>::infinity();
      return facts.numerator.size() < facts.denominator.size() ? 0 : std::abs(facts.numerator.back() / facts.denominator.back());
    }

    std::complex<double> value_of(const Polynomial &p, const std::complex<double> z)
    {
      std::complex<double> value = 0;
      for (std::size_t k = p.size(); k > 0; --k)
        value = value * z + p[k - 1];
      return value;
    }

    bool is_bounded_on_the_imaginary_axis(const ButcherFacts &facts)
    {
      constexpr double first = -4, last = 6, step = 0.005; // of the logarithm of y
      for (double exponent = first; exponent <= last; exponent += step)
        {
          const std::complex<double> z(0, std::pow(10, exponent));
          if (std::abs(value_of(facts.numerator, z) / value_of(facts.denominator, z)) > 1 + table_rounding)
            return false;
        }
      return true;
    }

    std::string text_of(const Polynomial &p)
    {
      std::ostringstream text;
      text << p[0];
      for (std::size_t k = 1; k < p.size(); ++k)
        if (p[k] != 0)
          text << (p[k] < 0 ? " - " : " + ") << std::abs(p[k]) << " z" << (k > 1 ? "^" + std::to_string(k) : "");
      return text.str();
    }

    /// What holds, and what of the next order does not.
    std::string tell_conditions(const ButcherFacts &facts)
    {
      std::vector<std::string> hold, fail;
      for (const OrderCondition &condition : facts.conditions)
        if (condition.order <= facts.order + 1)
          {
            const std::string  exact = condition.one_over == 1 ? "1" : "1/" + std::to_string(condition.one_over);
            std::ostringstream wrong;
            wrong << condition.quantity << " = " << condition.value << ", not " << exact;
            (condition.holds ? hold : fail).push_back(condition.holds ? condition.quantity + " = " + exact : wrong.str());
          }
      return "order conditions: " + join(hold) + (fail.empty() ? "" : "; of the next order: " + join(fail));
    }
  } // namespace

  bool ButcherTable::is_explicit() const
  {
    return std::all_of(a.begin(), a.end(), [](const std::vector<double> &row) { return row.back() == 0; });
  }

  bool ButcherTable::is_stiffly_accurate() const { return a.back() == b && b.back() != 0; }

  ButcherTable butcher_table(const DirkTable &table)
  {
    ButcherTable butcher{table.a, table.a.back()};
    if (table.error.empty())
      return butcher;
    butcher.embedded = butcher.b;
    for (std::size_t i = 0; i < table.error.size(); ++i)
      butcher.embedded[i] -= table.error[i];
    return butcher;
  }

  ButcherFacts facts_of(const ButcherTable &table)
  {
    ButcherFacts facts;
    facts.conditions       = conditions_of(table, table.b);
    facts.order            = order_of(facts.conditions);
    facts.embedded_order   = table.embedded.empty() ? 0 : order_of(conditions_of(table, table.embedded));
    facts.stage_order      = stage_order(table);
    facts.stiffly_accurate = table.is_stiffly_accurate();
    find_stability_function(table, facts);
    facts.at_infinity = at_infinity(facts);
    facts.a_stable    = facts.at_infinity <= 1 + table_rounding && is_bounded_on_the_imaginary_axis(facts);
    return facts;
  }

  std::string tell_stability(const ButcherFacts &facts)
  {
    std::ostringstream text;
    text << (facts.stiffly_accurate ? "stiffly accurate, " : "not stiffly accurate, ")
         << (facts.l_stable() ? "L-stable"
             : facts.a_stable ? "A-stable"
                              : "not A-stable");
    if (std::isfinite(facts.at_infinity))
      text << ", spectral radius at infinity " << (facts.at_infinity < table_rounding ? 0 : facts.at_infinity);
    return text.str();
  }

  std::vector<std::string> tell(const ButcherFacts &facts)
  {
    std::ostringstream orders;
    orders << "order " << facts.order << " (conditions up to order 4 are looked at), stages of order " << facts.stage_order << ", "
           << (facts.embedded_order > 0 ? "embedded formula of order " + std::to_string(facts.embedded_order) : "no embedded formula");
    return {orders.str(), tell_conditions(facts), tell_stability(facts),
            "R(z) = (" + text_of(facts.numerator) + ")" + (facts.denominator.size() > 1 ? " / (" + text_of(facts.denominator) + ")" : "")};
  }
} // namespace myolines
