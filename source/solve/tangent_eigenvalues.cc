// SPDX-License-Identifier: LGPL-2.1-or-later
#include "action_operator.h"

#include <myolines/base/error.h>
#include <myolines/solve/preconditioner.h>
#include <myolines/solve/tangent_eigenvalues.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <AnasaziBasicEigenproblem.hpp>
#include <AnasaziBlockDavidsonSolMgr.hpp>
#include <AnasaziEpetraAdapter.hpp>

#include <cmath>
#include <stdexcept>

namespace myolines
{
  namespace
  {
    using Eigenproblem = Anasazi::BasicEigenproblem<double, Epetra_MultiVector, Epetra_Operator>;
    using Davidson     = Anasazi::BlockDavidsonSolMgr<double, Epetra_MultiVector, Epetra_Operator>;

    constexpr unsigned int blocks_stored = 8;

    [[noreturn]] void refuse(const std::string &what, const std::string &expected)
    {
      throw InputError(InputProblem{"eigenvalues of the tangent", what, expected, ""});
    }

    /// A vector like @p layout, zero on constrained unknowns, without pattern: it has a part along every eigenvector. By global numbers and
    /// without a generator of random ones, so that equal runs find equal digits.
    Vector noise(const Vector &layout, const unsigned int number, const FreeUnknowns &free)
    {
      Vector x(layout.get_partitioner());
      for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
        x.local_element(i) = std::sin(1.7 * (number + 1) * (1. + x.get_partitioner()->local_to_global(i)));
      free.clear_constrained(x);
      return x;
    }

    std::vector<double> dense_eigenvalues(const TangentOperator &K, const TangentOperator *M, const std::vector<unsigned int> &free,
                                          const unsigned int number)
    {
      const unsigned int n      = free.size();
      const auto         matrix = [&](const TangentOperator *J) {
        dealii::LAPACKFullMatrix<double> all(n, n);
        Vector                           x(K.layout()), y(K.layout());
        for (unsigned int j = 0; j < n; ++j)
          {
            x                        = 0;
            x.local_element(free[j]) = 1;
            if (J != nullptr)
              J->apply(x, y);
            else
              y = x;
            for (unsigned int i = 0; i < n; ++i)
              all(i, j) = y.local_element(free[i]);
          }
        return all;
      };
      dealii::LAPACKFullMatrix<double>    stiffness = matrix(&K), of_right = matrix(M);
      std::vector<dealii::Vector<double>> vectors(1);
      stiffness.compute_generalized_eigenvalues_symmetric(of_right, vectors);
      std::vector<double> values;
      for (unsigned int i = 0; i < number; ++i)
        values.push_back(stiffness.eigenvalue(i).real());
      return values;
    }

    std::vector<double> davidson(const TangentOperator &K, const TangentOperator *M, const Preconditioner &inverse,
                                 const unsigned int number)
    {
      const Vector    &layout = K.layout();
      const Epetra_Map map    = layout.locally_owned_elements().make_trilinos_map(layout.get_mpi_communicator());
      Vector           from(layout), to(layout);
      const auto       action = [&](const TangentOperator &J) {
        return [&](const double *x, double *y) {
          std::copy_n(x, from.locally_owned_size(), from.begin());
          J.apply(from, to);
          std::copy_n(to.begin(), to.locally_owned_size(), y);
        };
      };
      const ActionOperator stiffness(map, action(K));
      const ActionOperator preconditioner(map, [&](const double *x, double *y) { inverse.apply(x, y); });

      const auto start = Teuchos::rcp(new Epetra_MultiVector(map, number));
      for (unsigned int j = 0; j < number; ++j)
        inverse.apply(noise(layout, j, K.free_unknowns()).begin(), (*start)[j]);

      // errors of eigenvalues are of second order in the residuals: tolerate 1e-6 of a typical one, B-normalised
      Vector x(layout), Bx(layout), Kx(layout);
      std::copy_n((*start)[0], x.locally_owned_size(), x.begin());
      K.apply(x, Kx);
      if (M != nullptr)
        M->apply(x, Bx);
      else
        Bx = x;
      const double square = x * Bx, typical = std::abs(x * Kx) / square * Bx.l2_norm() / std::sqrt(square);

      const auto problem = Teuchos::rcp(new Eigenproblem(Teuchos::rcp<const Epetra_Operator>(&stiffness, false), start));
      std::unique_ptr<const ActionOperator> mass;
      if (M != nullptr)
        {
          mass = std::make_unique<ActionOperator>(map, action(*M));
          problem->setM(Teuchos::rcp<const Epetra_Operator>(mass.get(), false));
        }
      problem->setPrec(Teuchos::rcp<const Epetra_Operator>(&preconditioner, false));
      problem->setHermitian(true);
      problem->setNEV(number);
      if (!problem->setProblem())
        throw std::runtime_error("Anasazi refuses the problem");

      Teuchos::ParameterList list;
      list.set("Which", "SR");
      list.set("Block Size", static_cast<int>(number));
      list.set("Num Blocks", static_cast<int>(blocks_stored));
      list.set("Maximum Restarts", 200);
      list.set("Convergence Tolerance", 1e-6 * typical);
      list.set("Relative Convergence Tolerance", false);
      list.set("Convergence Norm", "2");
      list.set("Verbosity", 0);
      if (Davidson(problem, list).solve() != Anasazi::Converged)
        throw std::runtime_error("the iteration has not converged after 200 restarts");
      std::vector<double> values;
      for (const auto &value : problem->getSolution().Evals)
        values.push_back(value.realpart);
      values.resize(number);
      return values;
    }
  } // namespace

  std::vector<double> smallest_eigenvalues(Linearisation &linearisation, const bool with_mass, const Constraints &constraints,
                                           const Vector &layout, const unsigned int number, const scene::Node &preconditioner,
                                           WorkLedger &ledger)
  {
    TangentOperator K(TangentOperator::Form::matrix_free, ledger), M(TangentOperator::Form::matrix_free, ledger);
    K.bind(linearisation, stage_weights(1, 0, 0), constraints, layout);
    M.bind(linearisation, stage_weights(0, 0, 1), constraints, layout);

    std::vector<unsigned int> free;
    for (unsigned int i = 0; i < layout.locally_owned_size(); ++i)
      if (!constraints.is_constrained(layout.get_partitioner()->local_to_global(i)))
        free.push_back(i);
    const MPI_Comm     all    = layout.get_mpi_communicator();
    const unsigned int n_free = dealii::Utilities::MPI::sum(static_cast<unsigned int>(free.size()), all);
    if (n_free < number)
      refuse("there are " + std::to_string(n_free) + " free unknowns and " + std::to_string(number) + " eigenvalues asked for", "fewer");

    // y.Kx = x.Ky for two vectors without pattern: an unsymmetric K would hold that by accident only.
    const Vector x = noise(layout, 0, K.free_unknowns()), y = noise(layout, 1, K.free_unknowns());
    Vector       Kx(x), Ky(y);
    K.apply(x, Kx);
    K.apply(y, Ky);
    if (std::abs(y * Kx - x * Ky) > 1e-8 * y.l2_norm() * Kx.l2_norm())
      refuse("the tangent is not symmetric (loads that follow the surface, activation as an unknown)", "a symmetric one");

    if (n_free < (blocks_stored + 2) * number)
      {
        if (dealii::Utilities::MPI::n_mpi_processes(all) > 1)
          refuse(std::to_string(n_free) + " free unknowns are too few for the iteration", "one rank, or fewer eigenvalues");
        return dense_eigenvalues(K, with_mass ? &M : nullptr, free, number);
      }
    try
      {
        const auto inverse = make_preconditioner(preconditioner, {layout.size(), linearisation.has_two_levels(), ledger});
        inverse->build(K);
        return davidson(K, with_mass ? &M : nullptr, *inverse, number);
      }
    catch (const std::runtime_error &error)
      {
        throw SolveError(std::string("The eigenvalues of the tangent cannot be computed: ") + error.what() + ".");
      }
  }

  std::vector<double> tangent_eigenvalues(const SemiDiscreteSystem &system, const State &state, const unsigned int number,
                                          const scene::Node &preconditioner, WorkLedger &ledger)
  {
    State rest = state;
    rest.v     = 0;
    rest.a     = 0;
    Vector           r(rest.u);
    const Evaluation evaluation = system.residual({rest.t, Side::left, rest.u, rest.v, rest.a}, r);
    if (!evaluation.admissible)
      throw SolveError("The state is inadmissible: " + evaluation.reason + ".");
    const auto linearisation = system.make_linearisation();
    system.linearise({rest.t, Side::left, rest.u, rest.v, rest.a}, *linearisation);
    return smallest_eigenvalues(*linearisation, system.capabilities().inertia, system.constraints(), rest.u, number, preconditioner,
                                ledger);
  }
} // namespace myolines
