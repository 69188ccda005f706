// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/solvers.h"

#include <complex>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace myolines::testing
{
  struct Motion
  {
    double u, v;
  };

  /// Coefficients of a monic polynomial from the highest power down, without the leading 1.
  using Polynomial = std::vector<double>;

  /// A method with certain parameters, and what theory says of it. One file case_<method>.cc for each method; the suite in
  /// verification.cc takes all it finds through integrators/list.def.
  struct Case
  {
    std::string  label; ///< for the names of tests; letters, digits, underscores
    Overrides    parameters;
    unsigned int order;

    /// Characteristic polynomial of one step of size 1 for u'' + 2 xi w u' + w^2 u = 0, zero eigenvalues left out.
    std::function<Polynomial(double w, double xi)> polynomial;

    /// Leading global error of u'' + u = 0, u(0) = 1, u'(0) = 0 at T, divided by dt^order.
    std::function<Motion(double T)> error;

    /// Names in the archive of what the next step depends on beyond (u, v, a), linearly, each with the differential order
    /// it goes with (0 like u, 2 like a).
    std::vector<std::pair<std::string, unsigned int>> history = {};

    double highest_frequency = 1e4;  ///< w up to which a step of size 1 is taken
    bool   scheme_rates      = true; ///< false: refused for moving boundaries

    /// Orders of u and v where single problems of exact.h show more than theory asks for.
    std::map<std::string, Motion> other_orders = {};

    unsigned int steps = 100; ///< on 1.7 s, for the measured order

    /// The estimated error of a small step is this times dt^k |(u, v)^(k)|, k the exponent of the estimate. None: it tends to the
    /// error itself.
    std::optional<double> estimate = {};

    bool estimate_is_asymptotic = true; ///< false: neither holds

    double work =
        0.15; ///< how far work times exponent may be from proportional to the tolerance, where steps of the start are many among few

    bool one_matrix = true; ///< false: the stages of a step have different weights

    bool controls_error = true; ///< false: refused where steps are chosen by error
  };

  /// All cases of the method called @p method in integrators/list.def.
  struct MethodCases
  {
    std::string       method; ///< as in list.def
    std::vector<Case> cases;
  };
  const std::vector<MethodCases> &method_cases();

  // Closed forms that several methods share.

  /// Polynomial with these roots, which come in conjugate pairs.
  Polynomial from_roots(const std::vector<std::complex<double>> &roots);

  /// det(x L - R) for 3x3 matrices.
  using Matrix3 = std::vector<std::vector<double>>;
  Polynomial from_pencil(const Matrix3 &l, const Matrix3 &r);

  /// Runge-Kutta methods: eigenvalues R(z) and its conjugate; R(z) = e^z (1 + C z^(p+1) + ...).
  Case runge_kutta_case(const std::string &label, unsigned int order, std::function<std::complex<double>(std::complex<double>)> stability,
                        double error_constant);

  /// sdirk2, tr-bdf2 and rosenbrock have one stability function, (1 + (1 - 2d) z)/(1 - d z)^2 with d = 1 - 1/sqrt(2).
  Case second_order_l_stable_case(const std::string &label);

  /// The generalized-alpha family in the convention of Chung and Hulbert.
  Case alpha_case(const std::string &label, const Overrides &parameters, double alpha_m, double alpha_f, double beta, double gamma);
} // namespace myolines::testing
