// SPDX-License-Identifier: LGPL-2.1-or-later
// A face that moves as one under a force, with a stop: closed forms, and the same body without a stop.
#include "bar.h"

#include <myolines/boundary/tendon_spring.h>
#include <myolines/system/drive_types.h>

namespace myolines
{
  namespace
  {
    using namespace test;

    Condition afterload(const double force, const double stiffness, const double position)
    {
      return condition("isotonic", 1, {set("force", force), set("stop/stiffness", stiffness), set("stop/position", position)});
    }

    Condition pulled_by(const double force) { return condition("isotonic", 1, {set("force", force)}); }

    TEST(Stop, PushesOnlyWhereTheFaceIsBeyondIt)
    {
      const auto stop = make_stop_spring(2e4);
      EXPECT_EQ(stop->force(1e-3), 0);
      EXPECT_EQ(stop->slope(1e-3), 0);
      EXPECT_EQ(stop->energy(1e-3), 0);
      EXPECT_EQ(stop->force(0), 0);
      EXPECT_EQ(stop->slope(0), 2e4);
      EXPECT_DOUBLE_EQ(stop->force(-1e-3), -20);
      EXPECT_DOUBLE_EQ(stop->energy(-1e-3), 0.01);
    }

    TEST(Stop, HoldsABarThatItsLoadStretches)
    {
      const double     position = 5e-4, stiffness = 1e4, force = 3;
      test::Simulation stopped(bar({held(0, "x"), afterload(force, stiffness, position)}));
      stopped.go("static", 1, 1., [](const State &) {});
      const double   q        = displacement(stopped, corner)[0];
      const Reaction reaction = measure_reactions(stopped.system, stopped.state).back();
      EXPECT_GT(q, position);
      EXPECT_NEAR(reaction.own[0], -stiffness * (q - position), 1e-12);
      EXPECT_NEAR(reaction.force[0], force + reaction.own[0], 1e-9);
      EXPECT_NEAR(measure_body(stopped.system, stopped.state, SlabRule::quadrature_points).stored_springs,
                  stiffness / 2 * (q - position) * (q - position), 1e-15);
      EXPECT_EQ(reaction.power, 0);

      test::Simulation pulled(bar({held(0, "x"), pulled_by(force + reaction.own[0])}));
      pulled.go("static", 1, 1., [](const State &) {});
      EXPECT_NEAR(displacement(pulled, corner)[0], q, 1e-11);
    }

    TEST(Stop, DoesNothingToAFaceThatDoesNotReachIt)
    {
      test::Simulation with(bar({held(0, "x"), afterload(3, 1e6, 0.01)})), without(bar({held(0, "x"), pulled_by(3)}));
      with.go("static", 1, 1., [](const State &) {});
      without.go("static", 1, 1., [](const State &) {});
      EXPECT_NEAR(displacement(with, corner)[0], displacement(without, corner)[0], 1e-14);
      EXPECT_EQ(measure_reactions(with.system, with.state).back().own[0], 0);
    }

    /// Length and forces of an active block, activated and relaxed in equal static steps, beside what they must be.
    TEST(Stop, AfterloadedBlockIsIsometricThenIsotonicThenIsometric)
    {
      const double       force = 5, stiffness = 1e7;
      Muscle3dParameters p = small_block(2, 3, 0);
      p.geometry.cells     = {{2, 1, 1}};
      p.dynamic            = false;
      p.activation         = std::make_shared<PiecewiseDrive>(PiecewiseDrive::lines({{0, 0}, {0.5, 1}, {1, 0}}));
      p.boundary           = {held(0), afterload(force, stiffness, 0)};

      Muscle3dParameters free = p; // without the stop: what the block does once it has left it
      free.boundary[1]        = pulled_by(force);

      std::vector<double> length, stop, pull, length_of_free;
      test::Simulation    run(p), freely(free);
      run.go("static", 20, 1., [&](const State &state) {
        if (state.t == 0)
          return;
        const Reaction reaction = measure_reactions(run.system, state).back();
        length.push_back(displacement(run, corner)[0]);
        stop.push_back(reaction.own[0]);
        pull.push_back(reaction.force[0]);
      });
      freely.go("static", 20, 1., [&](const State &state) {
        if (state.t > 0)
          length_of_free.push_back(displacement(freely, corner)[0]);
      });
      int on_the_stop = 0;
      for (std::size_t i = 0; i < length.size(); ++i)
        {
          EXPECT_NEAR(pull[i], force + stop[i], 1e-7);
          if (length_of_free[i] > 0) // the load is more than the block holds
            {
              ++on_the_stop;
              EXPECT_NEAR(length[i], -stop[i] / stiffness, 1e-15);
              EXPECT_LT(stop[i], 0);
              EXPECT_GE(pull[i], 0);
            }
          else
            {
              EXPECT_EQ(stop[i], 0);
              EXPECT_NEAR(length[i], length_of_free[i], 1e-9);
            }
        }
      EXPECT_GE(on_the_stop, 6);
      EXPECT_LE(on_the_stop, 14);
      EXPECT_GT(freely.solvers.ledger.counted("newton iterations"), 0u);
      EXPECT_LE(run.solvers.ledger.counted("newton iterations"), 2 * freely.solvers.ledger.counted("newton iterations"));
    }

    /// Total energy of a bar that its load drives against the stop, beside the work of the load: the largest difference in parts of the
    /// energy stored in the stop at most. The trapezoidal rule loses none but where the face touches and leaves.
    double drift(const unsigned int steps)
    {
      Muscle3dParameters p = bar({held(0, "x"), afterload(0.2, 2e3, 1e-4)});
      p.dynamic            = true;
      test::Simulation run(p);
      double           largest = 0, stored = 0, last = 0;
      run.go("newmark", steps, 0.03, [&](const State &state) {
        const BodyMeasures m = measure_body(run.system, state, SlabRule::quadrature_points);
        const double       q = displacement(run, corner)[0];
        stored               = std::max(stored, m.stored_springs);
        last                 = m.stored_springs;
        largest              = std::max(largest, std::abs(m.kinetic + m.stored_volumetric + m.stored_base + m.stored_springs - 0.2 * q));
      });
      EXPECT_GT(stored, 1e-6);
      EXPECT_LT(last, stored);
      return largest / stored;
    }

    TEST(Stop, GivesBackTheEnergyOfAnImpact)
    {
      const double coarse = drift(100), fine = drift(200);
      EXPECT_LT(fine, 0.05);
      EXPECT_LT(fine, 0.5 * coarse);
    }
  } // namespace
} // namespace myolines
