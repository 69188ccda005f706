// SPDX-License-Identifier: LGPL-2.1-or-later
// Energy balance of whole runs, and what runs do and do not compute.
#include "simulation.h"

#include <myolines/muscle3d/body_measures.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    using test::Simulation;

    /// strain(t) or activation(t) = height (1 - cos(pi t / 0.1))/2
    class SmoothRise : public Drive
    {
    public:
      explicit SmoothRise(const double height)
        : height_(height)
      {}
      double              value(double t, Side) const override { return height_ / 2 * (1 - std::cos(omega * t)); }
      double              first_derivative(double t, Side) const override { return height_ / 2 * omega * std::sin(omega * t); }
      double              second_derivative(double t, Side) const override { return height_ / 2 * omega * omega * std::cos(omega * t); }
      std::vector<double> kinks(double, double) const override { return {}; }

    private:
      static constexpr double omega = 31.41592653589793;
      double                  height_;
    };

    Muscle3dParameters contraction()
    {
      Muscle3dParameters p       = test::small_block(2, 3, 1);
      p.muscle().fibre.direction = {{std::cos(0.5), 0, std::sin(0.5)}};
      p.activation               = std::make_shared<SmoothRise>(0.5);
      p.boundary                 = test::slowly_pulled_ends(p, 0.03);
      return p;
    }

    /// |drift| of the energy balance at the end, and the largest energy seen.
    std::pair<double, double> drift(const unsigned int steps)
    {
      Simulation run(contraction());
      double     supplied = 0, rate = 0, t = 0, first = 0, energy = 0, largest = 0;
      bool       started = false;
      run.go("backward euler", steps, 0.1, [&](const State &state) {
        const BodyMeasures m     = measure_body(run.system, state, SlabRule::quadrature_points);
        double             power = m.active_power - m.dissipation;
        for (const Reaction &reaction : measure_reactions(run.system, state))
          power += reaction.power;
        energy = m.kinetic + m.stored_volumetric + m.stored_base + m.stored_passive;
        if (started)
          supplied += (state.t - t) * (power + rate) / 2;
        else
          first = energy;
        started = true;
        rate    = power;
        t       = state.t;
        largest = std::max(largest, energy);
      });
      return {energy - first - supplied, largest};
    }

    /// dE/dt = rates + sum of r v over the free unknowns, at any state: what systems state belongs to their residual.
    TEST(Energy, StatedByTheSystemBelongsToTheResidual)
    {
      Simulation   run(contraction());
      State        s    = run.system.initial_state(0.05);
      unsigned int seed = 1;
      for (const auto &[x, size] : {std::pair<Vector *, double>{&s.u, 1e-4}, {&s.v, 1e-2}, {&s.a, 1.}})
        {
          x->zero_out_ghost_values();
          Vector random = *x;
          test::randomise(random, size, seed++);
          for (const auto i : x->locally_owned_elements())
            if (!run.system.constraints().is_constrained(i))
              (*x)(i) = random(i);
          x->update_ghost_values();
        }
      const double h      = 1e-6;
      const auto   energy = [&](const double part) {
        State moved = s;
        for (const auto &[x, rate] : {std::pair<Vector *, const Vector *>{&moved.u, &s.v}, {&moved.v, &s.a}})
          {
            x->zero_out_ghost_values();
            x->add(part, *rate);
            x->update_ghost_values();
          }
        return run.system.energetics(moved, Side::left).energy;
      };
      Vector r = s.u;
      ASSERT_TRUE(run.system.residual({s.t, Side::left, s.u, s.v, s.a}, r).admissible);
      double free = 0, size = 0;
      for (const auto i : r.locally_owned_elements())
        if (!run.system.constraints().is_constrained(i))
          {
            free += r(i) * s.v(i);
            size += std::abs(r(i) * s.v(i));
          }
      const EnergyRates rates    = run.system.energetics(s, Side::left).rates;
      const double      expected = rates.active - rates.dissipation + rates.external + dealii::Utilities::MPI::sum(free, MPI_COMM_WORLD);
      EXPECT_NE(rates.active, 0);
      EXPECT_NEAR((energy(h) - energy(-h)) / (2 * h), expected, 1e-5 * dealii::Utilities::MPI::sum(size, MPI_COMM_WORLD));
    }

    TEST(Energy, BalanceClosesWithTheOrderOfTheMethod)
    {
      const auto [coarse, scale] = drift(40);
      const auto [fine, unused]  = drift(80);
      (void) unused;
      EXPECT_LT(std::abs(fine), 0.02 * scale);
      EXPECT_NEAR(coarse / fine, 2., 0.25) << coarse << " " << fine;
    }

    TEST(Energy, DissipationIsNotNegative)
    {
      Simulation run(contraction());
      run.go("backward euler", 10, 0.1,
             [&](const State &state) { EXPECT_GE(measure_body(run.system, state, SlabRule::quadrature_points).dissipation, -1e-12); });
    }

    TEST(Work, WithoutActivationNoActiveStress)
    {
      Muscle3dParameters p = contraction();
      p.activation         = nullptr;
      Simulation run(p);
      run.go("backward euler", 2, 0.02, [](const State &) {});
      const WorkLedger &ledger = run.solvers.ledger;
      EXPECT_GT(ledger.counted("residual evaluations"), 0u);
      for (const char *sweep : {"residual", "assembly", "stored tangent"})
        {
          EXPECT_EQ(ledger.counted(std::string("active stress in ") + sweep), 0u);
          EXPECT_EQ(ledger.counted(std::string("force-velocity in ") + sweep), 0u);
        }
    }

    TEST(Work, QuasiStaticBuildsNoMassAndNoRate)
    {
      Muscle3dParameters p = contraction();
      p.dynamic            = false;
      Simulation run(p);
      run.go("static", 2, 0.02, [](const State &) {});
      const WorkLedger &ledger = run.solvers.ledger;
      EXPECT_GT(ledger.counted("active stress in assembly"), 0u);
      for (const char *sweep : {"residual", "assembly", "stored tangent"})
        {
          EXPECT_EQ(ledger.counted(std::string("mass in ") + sweep), 0u);
          EXPECT_EQ(ledger.counted(std::string("force-velocity in ") + sweep), 0u);
        }
    }

    TEST(Work, ActiveDynamicScenesCountEverything)
    {
      Simulation run(contraction());
      run.go("backward euler", 1, 0.01, [](const State &) {});
      const WorkLedger &ledger = run.solvers.ledger;
      EXPECT_EQ(ledger.counted("active stress in assembly"), ledger.counted("matrix assemblies"));
      EXPECT_EQ(ledger.counted("mass in assembly"), ledger.counted("matrix assemblies"));
      EXPECT_GT(ledger.counted("force-velocity in residual"), 0u);
    }
  } // namespace
} // namespace myolines
