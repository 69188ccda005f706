// SPDX-License-Identifier: LGPL-2.1-or-later
// Newton's method with the exact tangent: few iterations, whatever the step.
#include "simulation.h"

namespace myolines
{
  namespace
  {
    /// activation(t) = t / 0.2 s
    class Ramp : public Drive
    {
    public:
      double              value(double t, Side) const override { return t / 0.2; }
      double              first_derivative(double, Side) const override { return 5; }
      double              second_derivative(double, Side) const override { return 0; }
      std::vector<double> kinks(double, double) const override { return {}; }
    };

    /// The isometric contraction of Flexodeal's reference runs: 3 x 1 x 1 cm, pennation 30 degrees, 64 cells, 5 points.
    Muscle3dParameters isometric()
    {
      Muscle3dParameters p       = test::small_block(2, 5, 2);
      p.muscle().fibre.direction = {{std::sqrt(0.75), 0, 0.5}};
      p.activation               = std::make_shared<Ramp>();
      p.boundary                 = test::held_ends();
      return p;
    }

    class NewtonIterations : public ::testing::TestWithParam<unsigned int>
    {
    };

    // From U_n to 1e-8 of the residual after the Dirichlet lift, with linear solves good enough not to show.
    TEST_P(NewtonIterations, AreAtMostFiveAndAHalfPerStep)
    {
      test::Simulation simulation(isometric(), {"relative tolerance=1e-8", "absolute tolerance=1e-14", "forcing maximum=1e-3"});
      simulation.go("backward euler", GetParam(), 0.2, [](const State &) {});
      const double per_step = double(simulation.solvers.ledger.counted("newton iterations")) / GetParam();
      RecordProperty("Newton iterations per step", std::to_string(per_step));
      EXPECT_LE(per_step, 5.5);
      EXPECT_GE(per_step, 2.); // fewer would mean that the tolerance is not the one named above
    }

    INSTANTIATE_TEST_SUITE_P(Steps, NewtonIterations, ::testing::Values(8u, 16u, 32u));

    // A fifth of its length within one step, while it is activated: the first guess from the velocity leads nowhere, which shows at once.
    TEST(NewtonIterationsOf, AFastPullInOneStepAreFew)
    {
      for (const double bulk_modulus : {1e7, 1e9})
        {
          Muscle3dParameters p    = isometric();
          p.n_points              = 3;
          p.muscle().bulk_modulus = bulk_modulus;
          p.boundary              = {test::condition(
                                         "strain", 1,
                                         {"strain/type=control points", "strain/points=0 0; 0.2 0.2", test::set("reference length", p.geometry.size[0])},
                                         "moving end"),
                                     test::held(0, "x y z", "fixed end")};
          test::Simulation simulation(p, {"relative tolerance=1e-15", "absolute tolerance=1e-8"});
          simulation.go("backward euler", 1, 0.2, [](const State &) {});
          EXPECT_LE(simulation.solvers.ledger.counted("newton iterations"), 13u) << bulk_modulus;
        }
    }

    TEST(NewtonIterationsOf, TheSymmetrisedTangentAreMore)
    {
      unsigned int iterations[2];
      for (const bool exact : {false, true})
        {
          Muscle3dParameters p = isometric();
          p.exact_tangent      = exact;
          p.n_points           = 3;
          test::Simulation simulation(p, {"relative tolerance=1e-8", "absolute tolerance=1e-14"});
          simulation.go("backward euler", 4, 0.05, [](const State &) {});
          iterations[exact] = simulation.solvers.ledger.counted("newton iterations");
        }
      EXPECT_GT(iterations[0], iterations[1]);
    }

    /// Thesis, remark 5.11: whatever the tangent makes of the strain rate, what the method converges to is the same, but it takes longer.
    TEST(NewtonIterationsOf, TheTangentsOfTheThesisAreMoreToTheSameSolution)
    {
      struct Run
      {
        double iterations;
        Vector u;
      };
      const auto run = [](const RateTangent &rate) {
        Muscle3dParameters p  = isometric();
        p.rate_tangent        = rate;
        p.n_points            = 3;
        p.geometry.refinement = 1;
        test::Simulation simulation(p, {"relative tolerance=1e-9", "absolute tolerance=1e-14", "maximum iterations=200"});
        simulation.go("backward euler", 4, 0.2, [](const State &) {});
        return Run{double(simulation.solvers.ledger.counted("newton iterations")), simulation.state.u};
      };
      const Run  exact    = run({});
      const auto compared = [&](const std::string &name, const RateTangent &rate, const double least, const double most) {
        Run other = run(rate);
        RecordProperty(name, std::to_string(other.iterations));
        EXPECT_GT(other.iterations, least * exact.iterations) << name;
        EXPECT_LT(other.iterations, most * exact.iterations) << name;
        other.u -= exact.u;
        EXPECT_LT(other.u.linfty_norm(), 1e-7 * exact.u.linfty_norm()) << name;
      };
      EXPECT_LE(exact.iterations, 18);
      compared("thesis", {1, 0, 0}, 1.2, 2);
      compared("flexodeal", {5, 0, 0}, 10, 20);
      compared("ross", {0, 0, -1}, 5, 12);
      compared("tam", {0, 0, 1}, 5, 12);
    }
  } // namespace
} // namespace myolines
