// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: forces of two states do the work that the stored energy loses, and have no moments; what is active or viscous acts between.
#include "simulation.h"

#include <myolines/measures/momenta.h>
#include <myolines/muscle3d/body_measures.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    using test::distort;
    using test::randomise;
    using test::small_block;

    struct Body
    {
      std::string  name;
      unsigned int degree, n_points;
      double       bulk_modulus;
      std::string  tissue = "muscle";
      bool         laws   = false; ///< all that have an energy
      bool         active = false; ///< and all others
      VolumeForm   volume = VolumeForm::thesis;

      Muscle3dParameters parameters() const
      {
        Muscle3dParameters p = small_block(degree, n_points, 0);
        p.geometry.cells     = {{2, 1, 1}};
        const auto direction = p.muscle().fibre.direction;
        for (const TissueKind &kind : tissue_kinds())
          if (kind.name == tissue)
            p.muscle() = kind.defaults;
        p.muscle().fibre.direction = direction;
        p.muscle().bulk_modulus    = bulk_modulus;
        p.volume_form              = volume;
        if (!active)
          p.activation = nullptr;
        for (const LawKind &kind : law_kinds())
          if ((laws && kind.has_energy) || active)
            p.muscle().laws.push_back({kind.name, kind.make(nullptr), 0.3});
        return p;
      }
    };
    void PrintTo(const Body &body, std::ostream *out) { *out << body.name; }

    class TwoStates : public ::testing::TestWithParam<Body>
    {
    protected:
      TwoStates()
        : system_(GetParam().parameters(), MPI_COMM_WORLD, ledger_)
      {
        system_.move_mesh(distort);
        begin_ = end_          = system_.still_state();
        zero_                  = begin_.u;
        const NodeSpace &space = *system_.discretisation().space;
        for (const auto node : space.nodes().locally_owned_dofs())
          {
            const dealii::Point<3> &x = space.node_position(node);
            for (unsigned int d = 0; d < 3; ++d)
              {
                begin_.u(3 * node + d) = 0.12 * x[d] + 4 * x[(d + 1) % 3] * x[(d + 2) % 3];
                end_.u(3 * node + d)   = -0.1 * x[d] + 0.4 * x[(d + 1) % 3] - 3 * x[d] * x[d]; // turned, too
                end_.v(3 * node + d)   = -0.5 * x[d];
              }
          }
        for (State *state : {&begin_, &end_})
          {
            Vector noise(state->u);
            randomise(noise, 1e-5, state == &end_ ? 1 : 2);
            state->u += noise;
          }
      }

      Vector force(const Vector &before, const Vector &after, const double dissipation = 0) const
      {
        Vector           r(after);
        const Evaluation evaluation = system_.residual({0, Side::left, after, end_.v, zero_, nullptr, &before, dissipation}, r);
        EXPECT_TRUE(evaluation.admissible) << evaluation.reason;
        return r;
      }

      double stored(const Vector &u) const { return system_.energetics({0, u, zero_, zero_}, Side::left).energy; }

      mutable WorkLedger ledger_;
      Muscle3dSystem     system_;
      State              begin_, end_;
      Vector             zero_;
    };

    TEST_P(TwoStates, TheWorkIsTheChangeOfEnergy)
    {
      if (GetParam().active)
        return;
      // large, usual, and below the change where the formula gives way to the midpoint
      for (const double part : {1., 1e-2, 1e-6})
        {
          Vector after(begin_.u), change(begin_.u);
          after.sadd(1 - part, part, end_.u);
          change -= after;
          const Vector f    = force(begin_.u, after);
          double       size = 0;
          for (const auto i : f.locally_owned_elements())
            size += std::abs(f(i) * change(i));
          const double work = -(f * change), energy = stored(after) - stored(begin_.u), rounding = 1e-14 * stored(begin_.u);
          EXPECT_NEAR(work, energy, 1e-12 * dealii::Utilities::MPI::sum(size, MPI_COMM_WORLD) + rounding) << part;
          if (part == 1)
            {
              EXPECT_GT(std::abs(energy), 1e-3 * stored(begin_.u));
            }
        }
    }

    /// By more the larger the dissipation, and over small changes of the body at rest by chi/2 of the work of the change of the force.
    TEST_P(TwoStates, DissipationTakesEnergy)
    {
      if (GetParam().active)
        return;
      for (const double part : {1., -0.3, 1e-2, 1e-4})
        {
          Vector after(begin_.u), change(begin_.u);
          after.sadd(1 - part, part, end_.u);
          change -= after;
          change *= -1;
          const double none = force(begin_.u, after) * change, half = force(begin_.u, after, 0.5) * change,
                       whole = force(begin_.u, after, 1) * change;
          EXPECT_GT(half - none, 0) << part;
          EXPECT_NEAR(whole - none, 2 * (half - none), 1e-9 * (whole - none) + 1e-13 * std::abs(none)) << part;
        }
      Vector after(end_.u);
      after *= 1e-3;
      Vector difference = force(after, after);
      difference -= force(zero_, zero_);
      const double taken = force(zero_, after, 1) * after - force(zero_, after) * after, half = difference * after / 2;
      EXPECT_NEAR(taken, half, 0.02 * half);
    }

    /// Resultant and moment about the origin of @p f on the body displaced by @p u.
    std::pair<dealii::Tensor<1, 3>, dealii::Tensor<1, 3>> resultants(const NodeSpace &space, const Vector &f, const Vector &u)
    {
      dealii::Tensor<1, 3> force, moment;
      for (const auto node : space.nodes().locally_owned_dofs())
        {
          dealii::Tensor<1, 3> x(space.node_position(node)), at;
          for (unsigned int d = 0; d < 3; ++d)
            {
              x[d] += u(3 * node + d);
              at[d] = f(3 * node + d);
            }
          force += at;
          moment += cross_product_3d(x, at);
        }
      return {dealii::Utilities::MPI::sum(force, MPI_COMM_WORLD), dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD)};
    }

    TEST_P(TwoStates, ForcesBalanceInTheMiddle)
    {
      Vector middle(begin_.u);
      middle.sadd(0.5, 0.5, end_.u);
      for (const double dissipation : {0., 0.7})
        {
          const Vector f           = force(begin_.u, end_.u, dissipation);
          const auto [sum, moment] = resultants(*system_.discretisation().space, f, middle);
          EXPECT_LT(sum.norm(), 1e-12 * f.l1_norm());
          EXPECT_LT(moment.norm(), 1e-12 * f.l1_norm() * 0.03);
        }
    }

    TEST_P(TwoStates, OfOneStateTheyAreItsForces)
    {
      Vector plain(end_.u);
      ASSERT_TRUE(system_.residual({0, Side::left, end_.u, end_.v, zero_}, plain).admissible);
      plain -= force(end_.u, end_.u);
      EXPECT_LT(plain.l2_norm(), 1e-12 * force(end_.u, end_.u).l2_norm());
    }

    /// The gap to the force in the middle falls with the square of the step.
    TEST_P(TwoStates, TheyAreOfSecondOrder)
    {
      double gaps[2];
      for (const int i : {0, 1})
        {
          const double part = i == 0 ? 0.04 : 0.02;
          Vector       after(begin_.u), middle(begin_.u), f(begin_.u);
          after.sadd(1 - part, part, end_.u);
          middle.sadd(1 - part / 2, part / 2, end_.u);
          ASSERT_TRUE(system_.residual({0, Side::left, middle, end_.v, zero_}, f).admissible);
          f -= force(begin_.u, after);
          gaps[i] = f.l2_norm();
        }
      EXPECT_NEAR(gaps[0] / gaps[1], 4, 0.7);
    }

    INSTANTIATE_TEST_SUITE_P(Of, TwoStates,
                             ::testing::Values(Body{"q1", 1, 2, 1e6}, Body{"q2", 2, 3, 1e6}, Body{"q2_nearly_incompressible", 2, 4, 1e9},
                                               Body{"q3", 3, 4, 1e7}, Body{"laws", 2, 3, 1e6, "muscle", true},
                                               Body{"tendon", 2, 3, 1e7, "tendon"},
                                               Body{"active_and_viscous", 2, 3, 1e6, "muscle", true, true},
                                               Body{"quadratic_volume", 2, 3, 1e6, "muscle", false, false, VolumeForm::quadratic},
                                               Body{"logarithmic_volume", 2, 3, 1e6, "muscle", false, false, VolumeForm::logarithmic}),
                             [](const auto &info) { return info.param.name; });

    /// A free bar, wound up and thrown, of a material of shear modulus @p mu and bulk modulus @p kappa.
    Muscle3dParameters thrown_bar(const double mu, const double kappa)
    {
      Muscle3dParameters p    = small_block(2, 3, 0);
      p.geometry.size         = {{0.06, 0.01, 0.01}};
      p.geometry.cells        = {{4, 1, 1}};
      p.activation            = nullptr;
      p.boundary              = {};
      p.muscle().bulk_modulus = kappa;
      p.muscle().base         = {};
      for (const LawKind &kind : law_kinds())
        if (kind.name == "yeoh")
          p.muscle().laws = {{"shear", kind.make(nullptr), mu / 2e4}};
      p.initial.velocity =
          std::array<std::string, 3>{{"20*y + 0.1", "6000*(x - 0.03)*(z - 0.005) + 10*x", "-6000*(x - 0.03)*(y - 0.005) - 5*x"}};
      return p;
    }

    class Thrown : public ::testing::TestWithParam<double>
    {
    };

    TEST_P(Thrown, BarsKeepEnergyAndMomenta)
    {
      constexpr double mu = 2e4;
      test::Simulation run(thrown_bar(mu, GetParam() * mu), {"relative tolerance=1e-12", "absolute tolerance=1e-13"});
      const Momenta    first          = measure_momenta(run.system, run.state);
      const auto       energy         = [&](const State &state) { return run.system.energetics(state, Side::left).energy; };
      const double     at_start       = energy(run.state);
      double           largest_stored = 0;
      run.go("energy momentum", 40, 0.04, [&](const State &state) {
        const Momenta now = measure_momenta(run.system, state);
        EXPECT_NEAR(energy(state), at_start, 1e-9 * at_start) << state.t;
        EXPECT_LT((now.momentum - first.momentum).norm(), 1e-10 * first.momentum.norm()) << state.t;
        EXPECT_LT((now.angular_momentum - first.angular_momentum).norm(), 1e-10 * first.angular_momentum.norm()) << state.t;
        State still    = state;
        still.v        = 0;
        largest_stored = std::max(largest_stored, energy(still));
      });
      EXPECT_GT(largest_stored, 0.1 * at_start);
    }

    INSTANTIATE_TEST_SUITE_P(KappaOverMu, Thrown, ::testing::Values(100., 5000.),
                             [](const auto &info) { return std::to_string(static_cast<int>(info.param)); });

    /// Momenta stay, and in every step energy falls, by more the more is damped.
    TEST(Thrown, ADissipativeMethodKeepsMomentaAndLosesEnergyOnly)
    {
      constexpr double mu   = 2e4;
      double           lost = 0;
      for (const char *radius : {"0.8", "0.4"})
        {
          test::Simulation run(thrown_bar(mu, 100 * mu), {"relative tolerance=1e-11", "absolute tolerance=1e-10"});
          const Momenta    first    = measure_momenta(run.system, run.state);
          const auto       energy   = [&](const State &state) { return run.system.energetics(state, Side::left).energy; };
          const double     at_start = energy(run.state);
          double           last     = at_start;
          run.go("dissipative energy momentum", 30, 0.03,
                 [&](const State &state) {
                   const Momenta now = measure_momenta(run.system, state);
                   EXPECT_LE(energy(state), last * (1 + 1e-10)) << state.t;
                   EXPECT_LT((now.momentum - first.momentum).norm(), 1e-10 * first.momentum.norm()) << state.t;
                   EXPECT_LT((now.angular_momentum - first.angular_momentum).norm(), 1e-10 * first.angular_momentum.norm()) << state.t;
                   last = energy(state);
                 },
                 {std::string("spectral radius at infinity=") + radius});
          EXPECT_GT(at_start - last, 1.2 * lost);
          lost = at_start - last;
        }
      EXPECT_GT(lost, 1e-4);
    }

    TEST(Held, ConstantLoadsAndSpringsKeepTheirEnergy)
    {
      Muscle3dParameters p = thrown_bar(2e4, 2e6);
      p.boundary           = {test::held(0), test::condition("traction", 1, {"traction y=2000"}),
                              test::condition("elastic foundation", 3, {"stiffness=1e5", "normal stiffness=2e5"})};
      p.initial.velocity   = std::nullopt;
      test::Simulation run(p, {"relative tolerance=1e-10"});
      const Energetics first = run.system.energetics(run.state, Side::right);
      double           work = 0, largest = 0;
      State            last = run.state;
      run.go("energy momentum", 20, 0.04, [&](const State &state) {
        const Energetics now = run.system.energetics(state, Side::left), before = run.system.energetics(last, Side::right);
        work += (state.t - last.t) / 2 * (before.rates.external + now.rates.external); // exact, as the load is constant
        last    = state;
        largest = std::max(largest, now.energy);
        EXPECT_NEAR(now.energy - first.energy, work, 1e-8 * largest) << state.t;
      });
      EXPECT_GT(largest, 1e-6);
    }

    /// Runs a held bar that is let go from a stretch or thrown, and watches its energy, which nothing changes.
    void expect_conserved(const BoundaryConditions &boundary, const std::string &velocity, const unsigned int steps)
    {
      Muscle3dParameters p = thrown_bar(2e4, 2e6);
      p.boundary           = boundary;
      p.initial.velocity   = std::array<std::string, 3>{{velocity, "0", "0"}};
      test::Simulation run(p, {"relative tolerance=1e-11", "absolute tolerance=1e-13"});
      const Energetics first = run.system.energetics(run.state, Side::right);
      double           most = 0, gap = 0;
      run.go("energy momentum", steps, steps * 2e-3, [&](const State &state) {
        const Energetics now = run.system.energetics(state, Side::left);
        EXPECT_NEAR(now.rates.external, 0, 1e-12) << state.t;
        State still = state;
        still.v     = 0;
        most        = std::max(most, run.system.energetics(still, Side::left).energy);
        gap         = std::max(gap, std::abs(now.energy - first.energy));
      });
      EXPECT_GT(most, 1e-2 * first.energy);
      EXPECT_LT(gap, 1e-6 * std::max(most, first.energy));
    }

    TEST(Held, CurvedTendonsAndStopsKeepTheirEnergy)
    {
      expect_conserved(
          {test::held(0), test::condition("tendon spring", 1,
                                          {"direction=-1 0 0", "spring/type=tendinous", "spring/force=3", "spring/slack length=0.05"})},
          "-20*x", 100);
      expect_conserved(
          {test::held(0), test::condition("isotonic", 1, {"direction=1 0 0", "force=0", "stop/stiffness=3e3", "stop/position=1e-3"})},
          "20*x", 100);
    }

    /// Where nothing moves the edge of the face a pressure that follows it has an energy.
    TEST(Held, PressuresOnFacesWithHeldEdgesKeepTheirEnergy)
    {
      expect_conserved({test::held(0), test::held(1), test::held(2), test::held(3),
                        test::condition("follower pressure", 5, {"pressure=2e3"}),
                        test::condition("follower pressure", 4, {"pressure=1e3"})},
                       "200*z*x*(0.06 - x)*y*(0.01 - y)/1e-7", 60);
    }

    /// What `check` says of follower pressures at z- and z+ of a bar that others hold.
    std::string energies_of_pressures(BoundaryConditions others, std::vector<std::string> above, std::vector<std::string> below)
    {
      above.push_back("pressure=2e3");
      below.push_back("pressure=1e3");
      others.push_back(test::condition("follower pressure", 5, above, "above"));
      others.push_back(test::condition("follower pressure", 4, below, "below"));
      Muscle3dParameters p = thrown_bar(2e4, 2e6);
      p.boundary           = others;
      WorkLedger           ledger;
      const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      for (const std::string &line : system.plan())
        if (line.find("pressures that follow") != std::string::npos)
          return line;
      return "none";
    }

    TEST(Held, CheckSaysWhichPressuresHaveAnEnergy)
    {
      const BoundaryConditions       sides = {test::held(0), test::held(1), test::held(2), test::held(3)};
      const std::vector<std::string> ramp  = {"profile/type=ramp", "profile/amplitude=1", "profile/duration=1"};
      const std::string              on    = "on   pressures that follow their face: ";
      EXPECT_EQ(energies_of_pressures(sides, {}, ramp),
                on + "above (z+) has an energy, below (z-) has no energy, it is no constant pressure");
      EXPECT_EQ(energies_of_pressures({test::held(0), test::held(1)}, {}, {"x from=0.01"}),
                on +
                    "above (z+) has no energy, the edge of its face is not held, below (z-) has no energy, the box of its face cuts cells");
      Muscle3dParameters pulled = thrown_bar(2e4, 2e6);
      EXPECT_EQ(energies_of_pressures(test::slowly_pulled_ends(pulled, 0.1), {}, {}),
                on + "above (z+) has no energy, a condition moves the body, below (z-) has no energy, a condition moves the body");
    }
  } // namespace
} // namespace myolines
