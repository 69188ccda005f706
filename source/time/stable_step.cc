// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/stable_step.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    /// A symmetric matrix with @p diagonal and, from its second row on, @p below.
    struct Tridiagonal
    {
      std::vector<double> diagonal, below;

      /// Whether an eigenvalue is larger than @p x: the pivots of the matrix minus x have the signs of its eigenvalues (Sylvester).
      bool reaches_beyond(const double x) const
      {
        double pivot = -1;
        for (std::size_t i = 0; i < diagonal.size(); ++i)
          {
            pivot = diagonal[i] - x - (i > 0 ? below[i - 1] * below[i - 1] / pivot : 0.);
            if (pivot >= 0)
              return true;
          }
        return false;
      }

      /// By bisection between the bounds of Gershgorin.
      double largest_eigenvalue() const
      {
        double low = diagonal[0], high = diagonal[0];
        for (std::size_t i = 0; i < diagonal.size(); ++i)
          {
            const double radius = (i > 0 ? std::abs(below[i - 1]) : 0.) + (i < below.size() ? std::abs(below[i]) : 0.);
            low                 = std::max(low, diagonal[i]);
            high                = std::max(high, diagonal[i] + radius);
          }
        for (unsigned int i = 0; i < 60 && low < high; ++i)
          {
            const double middle                   = low + (high - low) / 2;
            (reaches_beyond(middle) ? low : high) = middle;
          }
        return high;
      }
    };

    /// Entries of all signs, the same in every run and on any number of ranks; zero where constrained.
    void rough(const Constraints &constraints, Vector &x)
    {
      x.zero_out_ghost_values();
      for (const auto index : x.locally_owned_elements())
        x(index) = constraints.is_constrained(index) ? 0 : std::sin(1. + 12.9898 * index);
      x.update_ghost_values();
    }
  } // namespace

  /// With q orthonormal in M and p = M q, so that M itself is never applied: J q_k = b_k p_(k-1) + a_k p_k + b_(k+1) p_(k+1).
  double largest_eigenvalue(const std::function<void(const Vector &, Vector &)> &action, const SemiDiscreteSystem &system,
                            StageSolver &solver, const Vector &layout, StepReport &report)
  {
    constexpr unsigned int most = 100, stall = 8;
    constexpr double       resolved = 1e-5, nothing = 1e-10;
    Vector                 rest(layout), q(layout), p(layout), before(layout), product(layout);
    Tridiagonal            matrix;
    std::vector<double>    largest;
    rough(system.constraints(), rest);
    p           = 0;
    before      = 0;
    double size = 0;
    while (true)
      {
        q = 0;
        rest *= -1;
        record(solver.solve_linear({0, 0, 1}, rest, q), report); // M q = rest
        rest *= -1;
        if (!report.accepted())
          return 0;
        const double norm = std::sqrt(std::max(0., q * rest));
        // the space is exhausted, or rounding is all that is left of it
        if (norm <= nothing * size || matrix.diagonal.size() == most)
          break;
        if (!largest.empty())
          matrix.below.push_back(norm);
        p.swap(before);
        combine(p, {{1 / norm, &rest}});
        q *= 1 / norm;
        q.update_ghost_values();
        action(q, product);
        matrix.diagonal.push_back(q * product);
        const double b = matrix.below.empty() ? 0 : matrix.below.back();
        combine(rest, {{1, &product}, {-matrix.diagonal.back(), &p}, {-b, &before}});
        size = std::max({size, std::abs(matrix.diagonal.back()), b});
        largest.push_back(matrix.largest_eigenvalue());
        if (largest.size() > stall && std::abs(largest.back() - largest[largest.size() - 1 - stall]) <= resolved * std::abs(largest.back()))
          break;
      }
    return largest.empty() ? 0 : largest.back();
  }

  LargestEigenvalues largest_eigenvalues(const Point &point, const IntegratorContext &context, StageSolver &solver, StepReport &report)
  {
    context.ledger.count("stable step estimates");
    solver.linearise(point);
    const auto of = [&](const Weights &w) {
      return largest_eigenvalue([&](const Vector &x, Vector &y) { solver.apply(w, x, y); }, context.system, solver, point.u, report);
    };
    LargestEigenvalues eigenvalues;
    eigenvalues.stiffness = of({1, 0, 0});
    if (report.accepted() && context.system.capabilities().rates)
      eigenvalues.rates = of({0, 1, 0});
    return eigenvalues;
  }
} // namespace myolines
