// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace myolines
{
  struct DirkTable;

  /// Coefficients of a Runge-Kutta method whose stages need no later one,
  ///
  ///     y_i = y_0 + dt sum_j a_ij f(y_j),   y(t_0 + dt) = y_0 + dt sum_i b_i f(y_i),   c_i = sum_j a_ij.
  struct ButcherTable
  {
    std::vector<std::vector<double>> a;             ///< row i has i + 1 entries
    std::vector<double>              b;             ///< one for each stage
    std::vector<double>              embedded = {}; ///< weights of the formula that estimates errors; empty: there is none

    bool is_explicit() const;         ///< no stage is solved for: the diagonal is 0
    bool is_stiffly_accurate() const; ///< the last stage is the end of the step, and is solved for
  };

  /// The same method, with its weights and its embedded formula.
  ButcherTable butcher_table(const DirkTable &table);

  /// What an order asks of the coefficients.
  struct OrderCondition
  {
    unsigned int order;    ///< 1 to 4
    std::string  quantity; ///< for example "b A c": the sum over i and j of b_i a_ij c_j
    double       value;    ///< of these coefficients
    unsigned int one_over; ///< the exact value is 1/one_over
    bool         holds;    ///< within 1e-10, the rounding of coefficients with a dozen digits
  };

  /// What the coefficients say of the method (Hairer and Wanner, Solving Ordinary Differential Equations II,
  /// doi:10.1007/978-3-642-05221-7, chapters IV.3 and IV.6).
  struct ButcherFacts
  {
    std::vector<OrderCondition> conditions;         ///< all eight up to order 4
    unsigned int                order          = 0; ///< conditions up to order 4 are looked at
    unsigned int                embedded_order = 0; ///< likewise; 0: there is no embedded formula
    unsigned int                stage_order    = 0; ///< largest q up to 4 with sum_j a_ij c_j^(q-1) = c_i^q / q for all stages

    /// R(z) = numerator/denominator of u' = lambda u, z = lambda dt: the factor of one step. Coefficients of 1, z, z^2, ...
    std::vector<double> numerator;
    std::vector<double> denominator;              ///< likewise
    double              at_infinity      = 0;     ///< |R(z)| as z -> -infinity; may be infinity
    bool                stiffly_accurate = false; ///< ButcherTable::is_stiffly_accurate
    bool                a_stable         = false; ///< |R(i y)| <= 1, looked at for y from 1e-4 to 1e6
    /// A-stable, and nothing is left of the stiffest components after one step
    bool l_stable() const { return a_stable && at_infinity < 1e-12; }
  };

  ButcherFacts facts_of(const ButcherTable &table); ///< Computes them from the coefficients.

  /// Lines for `check`: orders, the conditions of the order and of the next one, stability, R(z).
  std::vector<std::string> tell(const ButcherFacts &facts);

  /// The line of stability alone.
  std::string tell_stability(const ButcherFacts &facts);
} // namespace myolines
