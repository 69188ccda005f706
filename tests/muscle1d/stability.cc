// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../support/table.h"
#include "run.h"

#include <myolines/muscle1d/equilibria.h>
#include <myolines/solve/modes.h>
#include <myolines/solve/tangent_eigenvalues.h>

#include <algorithm>
#include <cmath>

using namespace myolines;
using namespace myolines::testing;

namespace
{

  std::vector<std::complex<double>> chain_modes(const Overrides &settings)
  {
    WorkLedger ledger;
    Overrides  all{"perturbation=0"};
    all.insert(all.end(), settings.begin(), settings.end());
    const Muscle1dSystem system(read_isometric_chain(node(isometric_chain_schema(), all)), ledger);
    return modes(system, system.initial_state(0));
  }
} // namespace

// isometric_chain_equilibria.csv holds, of an independent program, those with short and long elements only.
TEST(Equilibria, ofTheBifurcatedChain)
{
  const auto                    table = rows("isometric_chain_equilibria.csv");
  const HillForce               force;
  std::vector<ChainEquilibrium> without_middle;
  unsigned int                  stable = 0, uniform = 0;
  for (const ChainEquilibrium &e : chain_equilibria(force, 1, 17, 1.15))
    {
      ASSERT_EQ(e.elements.size(), 3u);
      double sum = 0;
      for (unsigned int k = 0; k < 3; ++k)
        {
          sum += e.elements[k] * e.stretches[k];
          if (e.elements[k] > 0)
            {
              EXPECT_NEAR(force.isometric(e.stretches[k], 1).value, e.force, 1e-12);
            }
        }
      EXPECT_NEAR(sum, 17 * 1.15, 1e-10);
      if (e.elements[1] == 0)
        without_middle.push_back(e);
      stable += e.unstable_directions == 0;
      if (e.elements[1] == 17)
        {
          ++uniform;
          EXPECT_NEAR(e.stretches[1], 1.15, 1e-12);
          EXPECT_EQ(e.unstable_directions, 16u);
        }
    }
  EXPECT_EQ(uniform, 1u);
  ASSERT_EQ(without_middle.size(), table.size());
  EXPECT_GE(stable, table.size());
  for (std::size_t i = 0; i < table.size(); ++i)
    {
      const ChainEquilibrium &e = without_middle[table.size() - 1 - i];
      EXPECT_EQ(e.elements[2], number(table[i], 0));
      EXPECT_NEAR(e.stretches[0], number(table[i], 1), 1e-9);
      EXPECT_NEAR(e.stretches[2], number(table[i], 2), 1e-9);
      EXPECT_NEAR(e.force, number(table[i], 3), 1e-9);
      EXPECT_NEAR(e.slopes[0], number(table[i], 5), 1e-6);
      EXPECT_NEAR(e.slopes[2], number(table[i], 6), 1e-6);
      EXPECT_EQ(e.unstable_directions, 0u);
    }
}

TEST(Equilibria, onTheLimbsThatRiseThereIsOneThatIsStable)
{
  HillForce stabilised;
  stabilised.base = BaseMaterial::as_printed(0.0015, 5, 0.499);
  for (const auto &[force, stretch] :
       {std::make_pair(HillForce{}, 0.7), std::make_pair(HillForce{}, 1.7), std::make_pair(stabilised, 1.15)})
    {
      const auto all = chain_equilibria(force, 1, 17, stretch);
      ASSERT_EQ(all.size(), 1u) << stretch;
      EXPECT_EQ(all.front().unstable_directions, 0u);
    }
}

// Errata 8: +-2 sqrt((N - 1)|F'|/(l_s m)) sin(k pi/2N), imaginary where F' > 0; and against isometric_chain_eigenvalues.csv.
TEST(Modes, ofTheChainWithoutForceVelocity)
{
  for (const double stretch : {0.85, 1.15, 1.45})
    {
      const auto   all   = chain_modes({"stretch=" + text(stretch), "force velocity=false"});
      const double slope = HillForce{}.isometric(stretch, 1).slope, mass = 1060 * 525 / 225e3 * 0.3;
      ASSERT_EQ(all.size(), 32u);
      std::vector<double> sizes;
      for (const auto &w : all)
        {
          sizes.push_back(std::abs(w));
          EXPECT_NEAR(slope > 0 ? w.real() : w.imag(), 0, 1e-8 * std::abs(w));
        }
      std::sort(sizes.begin(), sizes.end());
      for (unsigned int k = 1; k <= 16; ++k)
        {
          const double w = 2 * std::sqrt(16 * 525 * std::abs(slope) / (0.3 / 17 * mass)) * std::sin(k * M_PI / 34);
          EXPECT_NEAR(sizes[2 * k - 1], w, 1e-9 * w);
          EXPECT_NEAR(sizes[2 * k - 2], w, 1e-9 * w);
        }
      for (const Row &row : rows("isometric_chain_eigenvalues.csv"))
        if (number(row, 0) == stretch)
          {
            EXPECT_NEAR(sizes[2 * std::stoul(row[1]) - 1], number(row, 2), 1e-6);
          }
    }
}

// The table was made with the slope of F_V below 0, the linearisation takes the one above.
TEST(Modes, ofTheChainWithForceVelocity)
{
  const double below = hill::force_velocity(-1e-13).slope;
  for (const double stretch : {0.85, 1.15, 1.45})
    {
      const Muscle1dParameters   p = read_isometric_chain(node(isometric_chain_schema()));
      const unsigned int         n = 16;
      const double               h = p.optimal_length / 17;
      dealii::FullMatrix<double> K(n, n), C(n, n), M(n, n);
      for (unsigned int i = 0; i < n; ++i)
        {
          M(i, i) = p.mass / n;
          for (unsigned int j = i == 0 ? 0 : i - 1; j < std::min(n, i + 2); ++j)
            {
              const double second = i == j ? 2 : -1;
              K(i, j)             = p.maximum_force / h * HillForce{}.isometric(stretch, 1).slope * second;
              C(i, j)             = p.maximum_force / h * hill::active(stretch).value * below / 5 * second;
            }
        }
      const auto all = quadratic_eigenvalues(K, C, M);
      for (unsigned int k = 1; k <= n; ++k)
        {
          // w^2 m + (c w + k) mu = 0, without cancellation
          const double mu = 4 * std::pow(std::sin(k * M_PI / 34), 2), half = C(0, 0) / 2 * mu / 2, k0 = K(0, 0) / 2 * mu, m = p.mass / n;
          const double fast = -(half + std::sqrt(half * half - m * k0)) / m, slow = k0 / m / fast;
          for (const double w : {fast, slow})
            {
              const auto nearest =
                  std::min_element(all.begin(), all.end(), [w](const auto &a, const auto &b) { return std::abs(a - w) < std::abs(b - w); });
              EXPECT_NEAR(nearest->real(), w, 1e-9 * std::abs(w));
            }
          for (const Row &row : rows("isometric_chain_eigenvalues.csv"))
            if (number(row, 0) == stretch && number(row, 1) == k)
              {
                EXPECT_NEAR(slow, number(row, 4), 1e-6);
                EXPECT_NEAR(fast, number(row, 6), 1e-9 * std::abs(fast));
              }
        }
      // and of the system itself: overdamped, the growth of errata 9
      const auto own = chain_modes({"stretch=" + text(stretch)});
      EXPECT_NEAR(own.front().real(), stretch == 1.15 ? 1.085 * 8.617344 / 8.745168 : all.front().real() * 8.617344 / 8.745168, 2e-3);
    }
}

TEST(Modes, ofTheMasslessUnitAndItsRefusals)
{
  WorkLedger           ledger;
  const Muscle1dSystem massless(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), {"masses=0"})), ledger);
  const auto           all = modes(massless, massless.initial_state(0));
  ASSERT_EQ(all.size(), 1u);
  const Muscle1dParameters &p = massless.parameters();
  const HillForce::Value    f = p.force(p.initial_stretch, 0, p.activation->value(0));
  const double              tendon =
      hill::tendon(massless.tendon_stretch(0, massless.initial_state(0).u)).slope * p.optimal_length / p.tendon->optimal_length;
  EXPECT_NEAR(all[0].real(), -(f.by_stretch + tendon) / f.by_rate, 1e-9 * std::abs(all[0]));

  const Muscle1dSystem mixed(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), {"masses=2", "activation=unknown"})), ledger);
  EXPECT_THROW(modes(mixed, mixed.initial_state(0)), InputError);
  const Muscle1dSystem large(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), {"masses=2001"})), ledger);
  EXPECT_THROW(modes(large, large.initial_state(0)), InputError);
}

// Without force-velocity small motions are e^(w t) with w^2 = -mu: the squares of the growth rates of an independent program.
TEST(Modes, ofTheChainAreTheEigenvaluesOfItsTangent)
{
  WorkLedger           ledger;
  const Muscle1dSystem system(
      read_isometric_chain(node(isometric_chain_schema(), {"perturbation=0", "stretch=1.15", "force velocity=false"})), ledger);
  const State         state = system.initial_state(0);
  std::vector<double> squares;
  for (const auto &w : modes(system, state))
    if (w.real() > 0)
      squares.push_back(-std::norm(w));
  std::sort(squares.begin(), squares.end());
  const auto mu = tangent_eigenvalues(system, state, 16, node(LinearSolver::preconditioner_schema()), ledger);
  ASSERT_EQ(squares.size(), 16u);
  for (unsigned int i = 0; i < 16; ++i)
    EXPECT_NEAR(mu[i], squares[i], 1e-9 * std::abs(squares[i]));
}
