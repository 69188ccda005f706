// SPDX-License-Identifier: LGPL-2.1-or-later
// Matrix-free smallest eigenvalues of the tangent against dense ones.
#include "simulation.h"

#include <myolines/solve/modes.h>
#include <myolines/solve/tangent_eigenvalues.h>

namespace myolines
{
  namespace
  {
    Muscle3dParameters held_block(const double activation)
    {
      Muscle3dParameters p = test::small_block();
      p.activation         = std::make_shared<test::ConstantDrive>(activation);
      p.boundary           = test::held_ends();
      return p;
    }

    std::vector<double> smallest(const Muscle3dParameters &parameters, const unsigned int number, const std::string &preconditioner)
    {
      WorkLedger           ledger;
      const Muscle3dSystem system(parameters, MPI_COMM_SELF, ledger);
      State                state = system.initial_state(0);
      Vector               push(state.u);
      test::randomise(push, 1e-5, 3);
      for (const auto i : state.u.locally_owned_elements())
        if (!system.constraints().is_constrained(i))
          state.u(i) += push(i);
      state.u.update_ghost_values();
      return tangent_eigenvalues(system, state, number,
                                 myolines::testing::node(LinearSolver::preconditioner_schema(), {"type=" + preconditioner}), ledger);
    }

    void expect_same(const std::vector<double> &few, const std::vector<double> &many)
    {
      for (std::size_t i = 0; i < few.size(); ++i)
        EXPECT_NEAR(few[i], many[i], 1e-7 * many[few.size()]) << i;
    }

    // 225 free unknowns: four of them take the iteration, thirty the dense matrix.
    TEST(TangentEigenvalues, OfTheActiveBlockAreThoseOfTheDenseMatrix)
    {
      Muscle3dParameters p = held_block(0.7);
      expect_same(smallest(p, 4, "direct"), smallest(p, 30, "direct"));
      p.dynamic = false;
      expect_same(smallest(p, 4, "p multigrid"), smallest(p, 30, "direct"));
    }

    // Without activation there is no force-velocity: w^2 = -mu.
    TEST(TangentEigenvalues, OfThePassiveBlockAreSquaresOfFrequencies)
    {
      WorkLedger           ledger;
      const Muscle3dSystem system(held_block(0), MPI_COMM_SELF, ledger);
      const State          state = system.initial_state(0);
      std::vector<double>  squares;
      for (const auto &w : modes(system, state))
        if (w.imag() > 0)
          squares.push_back(std::norm(w));
      std::sort(squares.begin(), squares.end());
      ASSERT_GT(squares.size(), 5u);
      const auto found = tangent_eigenvalues(system, state, 4, myolines::testing::node(LinearSolver::preconditioner_schema()), ledger);
      for (unsigned int i = 0; i < 4; ++i)
        EXPECT_NEAR(found[i], squares[i], 1e-6 * squares[i]);
    }
  } // namespace
} // namespace myolines
