// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cases.h"

#include <cmath>
#include <sstream>

#ifndef MYOLINES_SUITE_LIST
#  define MYOLINES_SUITE_LIST "../../integrators/list.def"
#endif

namespace myolines
{
#define MYOLINES_INTEGRATOR(name) IntegratorEntry name##_entry();
#include MYOLINES_SUITE_LIST
#undef MYOLINES_INTEGRATOR
} // namespace myolines

namespace myolines::testing
{
#define MYOLINES_INTEGRATOR(name) std::vector<Case> name##_cases();
#include MYOLINES_SUITE_LIST
#undef MYOLINES_INTEGRATOR

  const std::vector<MethodCases> &method_cases()
  {
    static const std::vector<MethodCases> all = {
#define MYOLINES_INTEGRATOR(name) MethodCases{name##_entry(), name##_cases()},
#include MYOLINES_SUITE_LIST
#undef MYOLINES_INTEGRATOR
    };
    return all;
  }

  std::string setting(const std::string &name, const double value)
  {
    std::ostringstream text;
    text.precision(17);
    text << name << "=" << value;
    return text.str();
  }

  Polynomial from_roots(const std::vector<std::complex<double>> &roots)
  {
    std::vector<std::complex<double>> coefficients = {1.};
    for (const std::complex<double> root : roots)
      {
        coefficients.push_back(0.);
        for (std::size_t i = coefficients.size() - 1; i > 0; --i)
          coefficients[i] -= root * coefficients[i - 1];
      }
    Polynomial real;
    for (std::size_t i = 1; i < coefficients.size(); ++i)
      real.push_back(coefficients[i].real());
    return real;
  }

  namespace
  {
    /// By Gauss, the largest pivot of each column first.
    double determinant(Rows a)
    {
      double product = 1;
      for (std::size_t k = 0; k < a.size(); ++k)
        {
          std::size_t pivot = k;
          for (std::size_t i = k + 1; i < a.size(); ++i)
            if (std::abs(a[i][k]) > std::abs(a[pivot][k]))
              pivot = i;
          if (a[pivot][k] == 0)
            return 0;
          if (pivot != k)
            {
              a[pivot].swap(a[k]);
              product = -product;
            }
          product *= a[k][k];
          for (std::size_t i = k + 1; i < a.size(); ++i)
            for (std::size_t j = a.size(); j-- > k;)
              a[i][j] -= a[i][k] / a[k][k] * a[k][j];
        }
      return product;
    }

    /// Columns of @p l replaced by those of @p r where the mask has a bit.
    Rows mixed(const Rows &l, const Rows &r, const unsigned int mask)
    {
      Rows m = l;
      for (std::size_t i = 0; i < l.size(); ++i)
        for (std::size_t j = 0; j < l.size(); ++j)
          if ((mask >> j & 1) != 0)
            m[i][j] = r[i][j];
      return m;
    }
  } // namespace

  Polynomial from_pencil(const Rows &l, const Rows &r)
  {
    // the determinant is linear in every column
    std::vector<double> sums(l.size() + 1);
    for (unsigned int mask = 0; mask < 1u << l.size(); ++mask)
      {
        std::size_t n = 0;
        for (std::size_t j = 0; j < l.size(); ++j)
          n += mask >> j & 1;
        sums[n] += (n % 2 == 0 ? 1 : -1) * determinant(mixed(l, r, mask));
      }
    Polynomial polynomial;
    for (std::size_t i = 1; i < sums.size(); ++i)
      polynomial.push_back(sums[i] / sums[0]);
    return polynomial;
  }

  Case runge_kutta_case(const std::string &label, const unsigned int order,
                        std::function<std::complex<double>(std::complex<double>)> stability, const double error_constant)
  {
    Case c;
    c.label      = label;
    c.order      = order;
    c.polynomial = [stability](const double w, const double xi) {
      const std::complex<double> z(-xi * w, std::sqrt(1 - xi * xi) * w);
      return from_roots({stability(z), std::conj(stability(z))});
    };
    c.error = [order, error_constant](const double T) {
      const std::complex<double> i(0, 1), u = T * error_constant * std::pow(i, order + 1) * std::exp(i * T);
      return Motion{u.real(), (i * u).real()};
    };
    return c;
  }

  Case second_order_l_stable_case(const std::string &label)
  {
    const double d = 1 - 1 / std::sqrt(2.);
    return runge_kutta_case(
        label, 2, [d](std::complex<double> z) { return (1. + (1 - 2 * d) * z) / ((1. - d * z) * (1. - d * z)); },
        d * d * (3 - 2 * d) - 1. / 6);
  }

  Case suzuki_case(const std::string &label)
  {
    const double              p = 1 / (4 - std::cbrt(4.));
    const std::vector<double> parts{p, p, 1 - 4 * p, p, p};
    const auto                stability = [parts](const std::complex<double> z) {
      std::complex<double> product(1);
      for (const double part : parts)
        product *= (1. + part / 2 * z) / (1. - part / 2 * z);
      return product;
    };
    double constant = 0; // ln (1 + x/2)/(1 - x/2) = x + x^3/12 + x^5/80 + ...
    for (const double part : parts)
      constant += std::pow(part, 5) / 80;
    Case c       = runge_kutta_case(label, 4, stability, constant);
    c.parameters = {"composition=suzuki"};
    c.polynomial = [stability](const double w, const double xi) {
      const std::complex<double> z(-xi * w, std::sqrt(1 - xi * xi) * w);
      return from_roots({stability(z), std::conj(stability(z)), -1.}); // an acceleration that u and v do not need
    };
    c.matrices               = 2;
    c.steps_of_constant      = 100;
    c.long_steps             = false;
    c.estimate_is_asymptotic = false; // rounding where the suite looks
    c.work                   = 0.4;   // few steps
    return c;
  }

  /// Eigenvectors e^(y n) with y = i W (1 - kappa W^2), W = omega dt, for second order; the leading terms of y and of v/u follow
  /// from the three equations by expansion in y.
  Case alpha_case(const std::string &label, const Overrides &parameters, const double alpha_m, const double alpha_f, const double beta,
                  const double gamma)
  {
    Case c;
    c.label        = label;
    c.parameters   = parameters;
    const double g = gamma - 0.5, s = alpha_m - alpha_f;
    c.order      = std::abs(g + s) < 1e-12 ? 2 : 1;
    c.steps      = c.order == 2 ? 100 : 1600;
    c.polynomial = [=](const double w, const double xi) {
      // (u, dt v, dt^2 a)
      const double x = 2 * xi * w, k = w * w, m = alpha_m, f = alpha_f;
      return from_pencil({{1, 0, -beta}, {0, 1, -gamma}, {k * (1 - f), x * (1 - f), 1 - m}},
                         {{1, 1, 0.5 - beta}, {0, 1, 1 - gamma}, {-k * f, -x * f, -m}});
    };
    const double kappa = (beta - 1. / 12 - g * alpha_f) / 2, lambda = kappa + 1. / 6 - beta + g / 2, decay = (g + s) / 2;
    if (c.order == 2)
      c.error = [=](const double T) { return Motion{kappa * T * std::sin(T), kappa * T * std::cos(T) + lambda * std::sin(T)}; };
    else
      c.error = [=](const double T) { return Motion{-decay * T * std::cos(T) + decay * std::sin(T), decay * T * std::sin(T)}; };
    return c;
  }
} // namespace myolines::testing
