// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: vectors in canonical order are the same sequence for any number of ranks. On one rank this proves that the order is
// complete; `mpirun -np N` of this program proves the rest (the tests parallel.canonical_order).

#include "fixtures.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace myolines;

namespace
{
  /// Positions of the unknowns with their components, in canonical order, all ranks one after the other.
  std::vector<double> sequence(const Muscle3dSystem &system, const MPI_Comm communicator)
  {
    const NodeSpace    &space = *system.discretisation().space;
    std::vector<double> own;
    for (const unsigned int i : system.canonical_order())
      {
        const auto unknown = space.owned_unknowns().nth_index_in_set(i);
        for (unsigned int c = 0; c < 3; ++c)
          own.push_back(space.node_position(unknown / 3)[c]);
        own.push_back(unknown % 3);
      }
    std::vector<double> all;
    for (const std::vector<double> &part : dealii::Utilities::MPI::all_gather(communicator, own))
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }
} // namespace

TEST(CanonicalOrder, DoesNotDependOnTheRanks)
{
  for (const std::array<unsigned int, 3> &cells :
       {std::array<unsigned int, 3>{{1, 1, 1}}, std::array<unsigned int, 3>{{5, 2, 3}}, std::array<unsigned int, 3>{{8, 1, 1}}})
    for (const unsigned int refinement : {0, 1, 2})
      for (const unsigned int degree : {1, 2, 3})
        {
          if (cells[1] == 2 && refinement == 2)
            continue; // many cells and nothing new
          Muscle3dParameters p = test::small_block(degree, degree + 1, refinement);
          p.geometry.cells     = cells;
          WorkLedger           ledger;
          const Muscle3dSystem shared(p, MPI_COMM_WORLD, ledger), whole(p, MPI_COMM_SELF, ledger);
          EXPECT_EQ(sequence(shared, MPI_COMM_WORLD), sequence(whole, MPI_COMM_SELF)) << cells[0] << " " << refinement << " " << degree;
        }
}

TEST(CanonicalOrder, DistortsTheMeshTheSameWayOnAllRanks)
{
  Muscle3dParameters p  = test::small_block(2, 3, 1);
  p.geometry.cells      = {{3, 1, 2}};
  p.geometry.distortion = 0.16;
  WorkLedger           ledger;
  const Muscle3dSystem shared(p, MPI_COMM_WORLD, ledger), whole(p, MPI_COMM_SELF, ledger);
  EXPECT_EQ(sequence(shared, MPI_COMM_WORLD), sequence(whole, MPI_COMM_SELF));
}

TEST(CanonicalOrder, HasEveryOwnedEntryOnce)
{
  WorkLedger                ledger;
  const Muscle3dSystem      system(test::small_block(2, 3, 1), MPI_COMM_WORLD, ledger);
  std::vector<unsigned int> order = system.canonical_order(), all(system.discretisation().space->owned_unknowns().n_elements());
  std::sort(order.begin(), order.end());
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(order, all);
}
