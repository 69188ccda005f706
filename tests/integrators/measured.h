// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "experiment.h"

#include <deal.II/lac/lapack_full_matrix.h>

namespace myolines::testing
{
  using Matrix = dealii::LAPACKFullMatrix<double>;

  inline void take_step(Integrator &integrator, State &state)
  {
    const StepReport report = integrator.step(1, state);
    if (!report.accepted())
      throw std::runtime_error(report.reason);
  }

  /// Transition matrix of one step of size 1 for u'' + 2 xi w u' + w^2 u = 0 in the variables (u, v/s, a/s^2, history), s =
  /// max(1, w), as the method takes it: from each unit vector.
  inline Matrix transition_matrix(const Verified &method, const double w, const double xi)
  {
    const double         s     = std::max(1., w);
    const auto          &names = method.facts.history;
    const unsigned int   n     = 3 + names.size();
    OscillatorParameters parameters;
    parameters.damping   = 2 * xi * w;
    parameters.stiffness = w * w;

    const auto scale = [&](const unsigned int i) { return std::pow(s, i < 3 ? i : names[i - 3].second); };
    Matrix     matrix(n, n);
    for (unsigned int column = 0; column < n; ++column)
      {
        Experiment experiment(method.entry, parameters, BoundaryRates::exact, method.facts.parameters);
        State     &state = experiment.state;
        experiment.integrator->start(state);
        if (!names.empty()) // first steps make the history, and remember their own sizes
          for (unsigned int step = 0; step < method.facts.starting_steps; ++step)
            take_step(*experiment.integrator, state);
        Vector zero(state.u);
        zero    = 0;
        state.u = state.v = state.a = zero;
        const auto unit             = [&](const unsigned int i) {
          Vector x(zero);
          x(0) = column == i ? scale(i) : 0;
          return x;
        };
        state.u = unit(0);
        state.v = unit(1);
        state.a = unit(2);

        Archive archive, after;
        experiment.integrator->save(archive);
        archive.put("first steps of a piece that are due", 0.); // which may be of another method
        for (unsigned int i = 0; i < names.size(); ++i)
          archive.put(names[i].first, unit(3 + i));
        experiment.integrator->load(archive);
        take_step(*experiment.integrator, state);
        experiment.integrator->save(after);
        std::vector<double> values = {state.u(0), state.v(0), state.a(0)};
        for (const auto &[name, differential_order] : names)
          {
            Vector history(zero);
            after.read(name, history);
            values.push_back(history(0));
          }
        for (unsigned int row = 0; row < n; ++row)
          matrix(row, column) = values[row] / scale(row);
      }
    return matrix;
  }

  /// Without the leading 1, by the recursion of Faddeev and LeVerrier, which needs no eigenvalues and so no care where they meet.
  inline Polynomial characteristic_polynomial(const Matrix &a)
  {
    const unsigned int         n = a.m();
    dealii::FullMatrix<double> matrix(n, n), power(n, n), next(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) = power(i, j) = a(i, j);
    Polynomial p;
    for (unsigned int k = 1; k <= n; ++k)
      {
        p.push_back(-power.trace() / k);
        for (unsigned int i = 0; i < n; ++i)
          power(i, i) += p.back();
        matrix.mmult(next, power);
        power = next;
      }
    return p;
  }

  /// Of largest modulus, with non-negative imaginary part; of several the one nearest to 1, which is no spurious root.
  inline std::complex<double> principal_root(const Polynomial &p)
  {
    const unsigned int n = p.size();
    Matrix             companion(n, n);
    for (unsigned int j = 0; j < n; ++j)
      companion(0, j) = -p[j];
    for (unsigned int i = 1; i < n; ++i)
      companion(i, i - 1) = 1;
    companion.compute_eigenvalues();
    std::complex<double> principal = companion.eigenvalue(0);
    for (unsigned int i = 1; i < n; ++i)
      {
        const std::complex<double> root = companion.eigenvalue(i);
        const double               more = std::abs(root) - std::abs(principal);
        if (more > 1e-6 || (more > -1e-6 && root.real() > principal.real()))
          principal = root;
      }
    return {principal.real(), std::abs(principal.imag())};
  }
} // namespace myolines::testing
