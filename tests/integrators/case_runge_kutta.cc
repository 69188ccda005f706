// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

#include <cmath>

namespace myolines::testing
{
  namespace
  {
    /// Stages one after the other for u' = lambda u.
    std::complex<double> factor(const std::vector<std::vector<double>> &a, const std::complex<double> z)
    {
      std::vector<std::complex<double>> u;
      for (const std::vector<double> &row : a)
        {
          std::complex<double> known = 1;
          for (std::size_t j = 0; j + 1 < row.size(); ++j)
            known += z * row[j] * u[j];
          u.push_back(known / (1. - row.back() * z));
        }
      return u.back();
    }

    /// Coefficient of z^(p + 1) in R(z) e^-z, from values on a small circle.
    double error_constant(const std::vector<std::vector<double>> &a, const unsigned int p)
    {
      constexpr unsigned int n      = 64;
      constexpr double       radius = 0.2;
      std::complex<double>   sum    = 0;
      for (unsigned int k = 0; k < n; ++k)
        {
          const std::complex<double> z = std::polar(radius, 2 * M_PI * k / n);
          sum += factor(a, z) * std::exp(-z) / std::pow(z, p + 1);
        }
      return sum.real() / n;
    }

    /// What the difference to the formula @p embedded is for u' = lambda u, in powers of z: the coefficient of z^@p k.
    double estimate(const std::vector<std::vector<double>> &a, const std::vector<double> &embedded, const unsigned int k)
    {
      std::vector<double> x(a.size(), 1.);
      for (unsigned int power = 1; power < k; ++power)
        {
          std::vector<double> next(a.size());
          for (std::size_t i = 0; i < a.size(); ++i)
            for (std::size_t j = 0; j < a[i].size(); ++j)
              next[i] += a[i][j] * x[j];
          x = next;
        }
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a.back()[i] - embedded[i]) * x[i];
      return std::abs(sum);
    }

    Case of(const std::string &label, const unsigned int order, const std::vector<std::vector<double>> &a, Overrides parameters)
    {
      Case c = runge_kutta_case(
          label, order, [a](const std::complex<double> z) { return factor(a, z); }, error_constant(a, order));
      c.parameters = std::move(parameters);
      return c;
    }
  } // namespace

  /// Coefficients as their authors print them, in decimals.
  std::vector<Case> runge_kutta_cases()
  {
    const double                           g = 0.4358665215084590;
    const std::vector<std::vector<double>> third{
        {0}, {g, g}, {0.2576482460664272, -0.0935147675748862, g}, {0.1876410243467238, -0.5952974735769549, 0.9717899277217721, g}};
    const std::vector<std::vector<double>> fourth{
        {0},
        {0.25, 0.25},
        {0.137776, -0.055776, 0.25},
        {0.14463686602698217, -0.22393190761334475, 0.4492950415863626, 0.25},
        {0.09825878328356478, -0.5915442428196704, 0.8101210538282996, 0.2831644057078060, 0.25},
        {0.15791629516167136, 0, 0.18675894052400077, 0.6805652953093346, -0.27524053099500667, 0.25}};
    Case c3   = of("esdirk3", 3, third, {});
    Case own3 = of("esdirk3_own_first_step", 3, third, {"first step=own"}),
         own4 = of("esdirk4_own_first_step", 4, fourth, {"table=esdirk4", "first step=own"});
    for (Case *c : {&c3, &own3})
      {
        c->steps    = 40;
        c->estimate = estimate(third, {0.2147402862233891, -0.4851622638849391, 0.8687250025203875, 0.4016969751411624}, 3);
      }
    own4.steps = 20;
    own4.work  = 0.35;
    own4.estimate =
        estimate(fourth, {0.1547118007632122, 0, 0.1892051916606802, 0.7020453712289219, -0.3191873990635791, 0.2732250354107649}, 4);
    // the trapezoidal rule to the middle, then BDF2
    const std::vector<std::vector<double>> composite{{0}, {0.25, 0.25}, {1. / 3, 1. / 3, 1. / 3}};
    Case                                   given = of("runge_kutta_of_the_scene", 2, composite, {"table=own", "A=0; 1/4 1/4; 1/3 1/3 1/3"});
    given.matrices                               = 2;
    // Alexander's method with the larger root, whose first stage lies beyond the step
    const double large  = 1 + std::sqrt(0.5);
    Case         beyond = of("runge_kutta_beyond_the_step", 2, {{large}, {1 - large, large}},
                             {"table=own", "A=1.7071067811865476; -0.7071067811865476 1.7071067811865476"});
    beyond.steps        = 320;
    return {c3, own3, own4, given, beyond};
  }
} // namespace myolines::testing
