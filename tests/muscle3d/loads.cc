// SPDX-License-Identifier: LGPL-2.1-or-later
// Loads from outside, against closed forms.
#include "simulation.h"

#include <myolines/measures/marker_probe.h>
#include <myolines/muscle3d/body_measures.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    using test::condition;
    using test::held;

    /// Stretches (l1, l2, l2) of a compressible Yeoh bar under P_11 = T, P_22 = 0, by Newton on the two equations.
    std::pair<double, double> uniaxial(const TissueParameters &tissue, const double T)
    {
      const auto stress = [&](const double l1, const double l2) {
        const double J = l1 * l2 * l2, power = std::pow(J, -2. / 3), I1 = power * (l1 * l1 + 2 * l2 * l2), x = I1 - 3;
        const double psi1 = tissue.base.scale * (tissue.base.c[0] + 2 * tissue.base.c[1] * x + 3 * tissue.base.c[2] * x * x);
        const double p    = tissue.bulk_modulus / 2 * (J - 1 / J);
        const auto   P    = [&](const double l) { return p * J / l + psi1 * (2 * power * l - 2. / 3 * I1 / l); };
        return std::make_pair(P(l1) - T, P(l2));
      };
      double l1 = 1, l2 = 1;
      for (int i = 0; i < 50; ++i)
        {
          const double h  = 1e-7;
          const auto   r  = stress(l1, l2);
          const auto   d1 = stress(l1 + h, l2);
          const auto   d2 = stress(l1, l2 + h);
          const double a = (d1.first - r.first) / h, b = (d2.first - r.first) / h;
          const double c = (d1.second - r.second) / h, d = (d2.second - r.second) / h;
          const double det = a * d - b * c;
          l1 -= (d * r.first - b * r.second) / det;
          l2 -= (a * r.second - c * r.first) / det;
        }
      return {l1, l2};
    }

    TEST(Traction, StretchesABarAsInClosedForm)
    {
      const double       T    = 3e4; // Pa
      Muscle3dParameters p    = test::small_block(2, 3, 1);
      p.dynamic               = false;
      p.activation            = nullptr;
      p.muscle().fibre.sigma0 = 0;
      p.boundary              = {held(0, "x"), held(2, "y"), held(4, "z"), condition("traction", 1, {"traction x=3e4"})};

      test::Simulation simulation(p);
      simulation.go("static", 1, 1., [](const State &) {});
      const auto [l1, l2] = uniaxial(p.muscle(), T);
      EXPECT_GT(l1, 1.05);
      const MarkerProbe corner(simulation.system, {{"corner", dealii::Point<3>(0.03, 0.01, 0.01)}}, "test");
      const auto        u = corner.displacements(simulation.state)[0];
      EXPECT_NEAR(u[0], 0.03 * (l1 - 1), 1e-10);
      EXPECT_NEAR(u[1], 0.01 * (l2 - 1), 1e-10);
      EXPECT_NEAR(u[2], 0.01 * (l2 - 1), 1e-10);
      EXPECT_NEAR(measure_reactions(simulation.system, simulation.state)[0].force[0], -T * 1e-4, 1e-9);
    }

    TEST(Traction, ThatIsNoNumberIsSeen)
    {
      WorkLedger         ledger;
      Muscle3dParameters p = test::small_block(2, 3, 1);
      p.boundary           = {held(0, "x"), condition("traction", 1, {"traction x=sqrt(t-1)"})};
      const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      const State          rest = system.initial_state(0);
      Vector               r(rest.u);
      system.residual({0, Side::left, rest.u, rest.v, rest.a}, r);
      EXPECT_TRUE(std::any_of(r.begin(), r.end(), [](const double x) { return std::isnan(x); }));
    }

    TEST(Reactions, OnSharedEdgesAreCountedOnce)
    {
      Muscle3dParameters p = test::small_block(2, 3, 1); // active: pulls on what holds it
      p.dynamic            = false;
      p.boundary           = {held(0), held(4, "z"), held(5, "z")};
      test::Simulation simulation(p);
      simulation.go("static", 1, 1., [](const State &) {});
      dealii::Tensor<1, 3> sum;
      double               largest = 0;
      for (const Reaction &reaction : measure_reactions(simulation.system, simulation.state))
        {
          sum += reaction.force;
          largest = std::max(largest, reaction.force.norm());
        }
      EXPECT_GT(largest, 0.1);
      EXPECT_LT(sum.norm(), 1e-8 * largest); // nothing else acts on the body
    }

    TEST(BodyForce, AcceleratesAFreeBodyAsAWhole)
    {
      Muscle3dParameters p = test::small_block(2, 3, 1);
      p.activation         = nullptr;
      p.body_force         = std::array<std::string, 3>{{"1060*2*t", "0", "1060*9.81"}};
      test::Simulation simulation(p);
      const unsigned   n = 10;
      simulation.go("backward euler", n, 0.1, [](const State &) {});
      // Backward Euler on a = 2 t: v_n = dt sum 2 t_k = 2 dt^2 n (n + 1)/2; on constant a: v = a t.
      const BodyMeasures m  = measure_body(simulation.system, simulation.state, SlabRule::quadrature_points);
      const double       vx = 0.01 * 0.01 * n * (n + 1), vz = 9.81 * 0.1, mass = 1060 * 3e-6;
      EXPECT_NEAR(m.kinetic, mass / 2 * (vx * vx + vz * vz), 1e-9 * m.kinetic);
      EXPECT_NEAR(m.body_force_power, mass * (2 * 0.1 * vx + 9.81 * vz), 1e-9 * m.body_force_power);
      EXPECT_NEAR(m.min_jacobian, 1, 1e-9);
    }

    TEST(PrescribedMotion, FormulasGiveTheRigidRotationTheyDescribe)
    {
      Muscle3dParameters p = test::small_block(1, 2, 1);
      p.activation         = nullptr;
      p.dynamic            = false;
      for (const unsigned int face : {0u, 1u})
        p.boundary.push_back(
            condition("formula", face,
                      {"displacement x=x*cos(t)-z*sin(t)-x", "displacement z=x*sin(t)+z*cos(t)-z", "velocity x=-x*sin(t)-z*cos(t)",
                       "velocity z=x*cos(t)-z*sin(t)", "acceleration x=-x*cos(t)+z*sin(t)", "acceleration z=-x*sin(t)-z*cos(t)"}));
      test::Simulation simulation(p);
      simulation.go("static", 4, 0.4, [](const State &) {});
      const MarkerProbe middle(simulation.system, {{"middle", dealii::Point<3>(0.015, 0.005, 0.01)}}, "test");
      const auto        u = middle.displacements(simulation.state)[0];
      EXPECT_NEAR(u[0], 0.015 * std::cos(0.4) - 0.01 * std::sin(0.4) - 0.015, 1e-11);
      EXPECT_NEAR(u[1], 0, 1e-11);
      EXPECT_NEAR(u[2], 0.015 * std::sin(0.4) + 0.01 * std::cos(0.4) - 0.01, 1e-11);
    }
  } // namespace
} // namespace myolines
