// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/solvers.h"

#include <myolines/time/integrator.h>

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

  /// A method with certain parameters, and what theory says of it. The file case_<method>.cc of a method gives its cases, and the suite
  /// (verification.cc, contract.cc, error_control.cc) takes all that its list names. What is measured, and against what:
  ///
  /// - Order: of u and v on the problems of exact.h, root mean squares over [0, 1.7], between @p steps and twice as many steps, to 0.05.
  /// - Error constant: at 1.7 with 8000 steps (order 1), 2000 (order 2) or @p steps_of_constant against @p error, to 1 %. It includes what
  /// the first steps do.
  /// - Amplification: the transition matrix of a step of size 1 for u'' + 2 xi w u' + w^2 u = 0, xi = 0 and 0.1, w from 0.01 to
  ///   @p highest_frequency, in (u, v, a) and what @p history names; its characteristic polynomial against @p polynomial, to 1e-9. Before
  ///   it is measured, @p starting_steps steps of size 1 make the history; all of it, and the state, is then replaced by unit vectors, so
  ///   that the step must be linear in them and depend on nothing else but numbers.
  /// - A constant acceleration is followed exactly by methods of order 2 or more, unless @p exact_start is false.
  /// - Boundaries: u, v, a exact with exact rates; with scheme rates u is exact and v a difference formula, or @p scheme_rates is false and
  ///   the facts of the method say so.
  /// - Kinks are landed on and left with right limits: start() begins anew, whatever was remembered.
  /// - Work: a linear system is linearised once, and of matrices with new weights no more than @p matrices are assembled in a step, none if
  ///   that is 1.
  /// - Promises of Integrator: failed steps leave the state bit-equal; save() and load() go on bit for bit; iterations are counted.
  /// - Error control, if @p controls_error: estimates against errors, work over tolerance, refused steps without a trace, kinks.
  struct Case
  {
    std::string  label;      ///< for the names of tests; letters, digits, underscores
    Overrides    parameters; ///< "theta=1.4"; numbers by setting(), with all their digits
    unsigned int order;

    /// Characteristic polynomial of one step of size 1 for u'' + 2 xi w u' + w^2 u = 0, zero eigenvalues left out; of any degree.
    std::function<Polynomial(double w, double xi)> polynomial;

    /// Leading global error of u'' + u = 0, u(0) = 1, u'(0) = 0 at T, divided by dt^order.
    std::function<Motion(double T)> error;

    /// Names in the archive of what the next step depends on beyond (u, v, a), linearly, each with the differential order
    /// it goes with (0 like u, 2 like a). Any number of them.
    std::vector<std::pair<std::string, unsigned int>> history = {};

    unsigned int starting_steps = 1; ///< of a piece, until all of the history is there, or steps are by the method's own formulas

    double highest_frequency = 1e4;  ///< w up to which a step of size 1 is taken
    bool   scheme_rates      = true; ///< false: refused for moving boundaries
    bool   exact_start       = true; ///< false: the first step is of first order

    /// Orders of u and v where single problems of exact.h show more than theory asks for.
    std::map<std::string, Motion> other_orders = {};

    unsigned int steps = 100; ///< on 1.7 s, for the measured order

    unsigned int steps_of_constant = 400; ///< for the error constant, beyond order 2: fewer where it would drown in rounding

    /// The estimated error of a small step is this times dt^k |(u, v)^(k)|, k the exponent of the estimate. None: it tends to the
    /// error itself.
    std::optional<double> estimate = {};

    bool estimate_is_asymptotic = true; ///< false: neither holds

    double work =
        0.15; ///< how far work times exponent may be from proportional to the tolerance, where steps of the start are many among few

    unsigned int matrices = 1; ///< of different weights in a step, as its stages have them

    bool controls_error = true; ///< false: refused where steps are chosen by error

    bool long_steps = true; ///< false: steps in phases without motion are limited by stability, or by what the method does not damp
  };

  /// "theta=1.3999999999999999": all digits of @p value.
  std::string setting(const std::string &name, double value);

  /// A method of the list, and its cases: functions <name>_entry() and <name>_cases().
  struct MethodCases
  {
    IntegratorEntry   entry;
    std::vector<Case> cases;
  };

  /// Of integrators/list.def, or of the list that MYOLINES_SUITE_LIST names.
  const std::vector<MethodCases> &method_cases();

  // Closed forms that several methods share.

  /// Polynomial with these roots, which come in conjugate pairs.
  Polynomial from_roots(const std::vector<std::complex<double>> &roots);

  /// det(x L - R) / det(L) of square matrices; of few rows, as every subset of columns is looked at.
  using Rows = std::vector<std::vector<double>>;
  Polynomial from_pencil(const Rows &l, const Rows &r);

  /// Runge-Kutta methods: eigenvalues R(z) and its conjugate; R(z) = e^z (1 + C z^(p+1) + ...).
  Case runge_kutta_case(const std::string &label, unsigned int order, std::function<std::complex<double>(std::complex<double>)> stability,
                        double error_constant);

  /// sdirk2, tr-bdf2 and rosenbrock have one stability function, (1 + (1 - 2d) z)/(1 - d z)^2 with d = 1 - 1/sqrt(2).
  Case second_order_l_stable_case(const std::string &label);

  /// Suzuki's composition of the implicit midpoint rule.
  Case suzuki_case(const std::string &label);

  /// The generalized-alpha family in the convention of Chung and Hulbert.
  Case alpha_case(const std::string &label, const Overrides &parameters, double alpha_m, double alpha_f, double beta, double gamma);
} // namespace myolines::testing
