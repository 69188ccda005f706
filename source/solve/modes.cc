// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/solve/free_unknowns.h>
#include <myolines/solve/modes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    using Matrix  = dealii::FullMatrix<double>;
    using Numbers = std::vector<std::complex<double>>;

    Numbers eigenvalues(const Matrix &matrix)
    {
      dealii::LAPACKFullMatrix<double> lapack(matrix.m(), matrix.n());
      lapack = matrix;
      lapack.compute_eigenvalues();
      Numbers all(matrix.m());
      for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = lapack.eigenvalue(i);
      return all;
    }

    bool regular(const Matrix &matrix)
    {
      dealii::LAPACKFullMatrix<double> lapack(matrix.m(), matrix.n());
      lapack            = matrix;
      const double norm = lapack.l1_norm();
      try
        {
          lapack.invert();
        }
      catch (const dealii::ExceptionBase &)
        {
          return false;
        }
      return norm * lapack.l1_norm() < 1e15; // the condition number
    }

    /// left^-1 right
    Matrix solved(const Matrix &left, const Matrix &right)
    {
      Matrix inverse(left.m(), left.n()), product(left.m(), right.n());
      inverse.invert(left);
      inverse.mmult(product, right);
      return product;
    }

    /// Eigenvalues of (u, v)' = (v, -A^-1 (B v + D u)): w^2 A + w B + D.
    Numbers companion(const Matrix &A, const Matrix &B, const Matrix &D)
    {
      const std::size_t n    = A.m();
      const Matrix      by_v = solved(A, B), by_u = solved(A, D);
      Matrix            all(2 * n, 2 * n);
      for (std::size_t i = 0; i < n; ++i)
        {
          all(i, n + i) = 1;
          for (std::size_t j = 0; j < n; ++j)
            {
              all(n + i, j)     = -by_u(i, j);
              all(n + i, n + j) = -by_v(i, j);
            }
        }
      return eigenvalues(all);
    }

    void sort_by_size(Numbers &numbers)
    {
      std::sort(numbers.begin(), numbers.end(), [](const auto &a, const auto &b) { return std::abs(a) < std::abs(b); });
    }

    void sort_by_growth(Numbers &numbers)
    {
      std::sort(numbers.begin(), numbers.end(),
                [](const auto &a, const auto &b) { return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag(); });
    }
  } // namespace

  std::vector<std::complex<double>> quadratic_eigenvalues(const Matrix &K, const Matrix &C, const Matrix &M)
  {
    Numbers all;
    if (M.empty())
      {
        if (!regular(C))
          throw SolveError("The modes cannot be computed: the matrix of the rates is singular.");
        all = eigenvalues(solved(C, K));
        for (auto &w : all)
          w = -w;
      }
    else
      {
        if (!regular(M))
          throw SolveError("The modes cannot be computed: the mass is singular.");
        all = companion(M, C, K);
        sort_by_size(all);
        if (regular(K))
          {
            Numbers inverse = companion(K, C, M); // 1/w
            sort_by_size(inverse);
            // conjugate pairs stay together
            std::size_t half = all.size() / 2;
            while (half > 0 && half < all.size() && std::abs(all[half]) <= (1 + 1e-6) * std::abs(all[half - 1]))
              --half;
            for (std::size_t i = 0; i < half; ++i)
              all[i] = 1. / inverse[all.size() - 1 - i];
          }
      }
    sort_by_growth(all);
    return all;
  }

  std::vector<std::complex<double>> modes(const SemiDiscreteSystem &system, const State &state)
  {
    const Capabilities capabilities = system.capabilities();
    const auto         refuse       = [](const std::string &what, const std::string &expected) {
      throw InputError(InputProblem{"modes", what, expected, ""});
    };
    if (dealii::Utilities::MPI::n_mpi_processes(state.u.get_mpi_communicator()) > 1)
      refuse("there are several ranks", "one rank: the matrices are dense");
    if (capabilities.orders.size() != 1 || capabilities.orders.front() == 0)
      refuse("the system has unknowns of several orders in time, or algebraic ones",
             "unknowns of second order only, or of first order only");
    std::vector<unsigned int> free;
    for (unsigned int i = 0; i < state.u.locally_owned_size(); ++i)
      if (!system.constraints().is_constrained(i))
        free.push_back(i);
    if (free.size() > most_unknowns_of_modes)
      refuse("the system has " + std::to_string(free.size()) + " free unknowns",
             "at most " + std::to_string(most_unknowns_of_modes) + ": the matrices are dense");

    const auto linearisation = system.make_linearisation();
    system.linearise({state.t, Side::right, state.u, state.v, state.a}, *linearisation);
    FreeUnknowns constraints(system.constraints(), state.u);
    const auto   dense = [&](const Weights &w) {
      Matrix matrix(free.size(), free.size());
      Vector x(state.u), y(state.u);
      for (std::size_t j = 0; j < free.size(); ++j)
        {
          x                        = 0;
          x.local_element(free[j]) = 1;
          constraints.distribute(x);
          linearisation->apply({{w, w, w}}, x, y);
          constraints.condense(y);
          for (std::size_t i = 0; i < free.size(); ++i)
            matrix(i, j) = y.local_element(free[i]);
        }
      return matrix;
    };
    const bool second = capabilities.orders.front() == 2;
    if (second && !capabilities.inertia)
      refuse("the system has no inertia", "a dynamic system");
    return quadratic_eigenvalues(dense({1, 0, 0}), dense({0, 1, 0}), second ? dense({0, 0, 1}) : Matrix());
  }
} // namespace myolines
