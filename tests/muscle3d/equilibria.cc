// SPDX-License-Identifier: LGPL-2.1-or-later
// The quasi-static muscle: whatever advances it, every step ends in equilibrium, and rates are those of the equilibria.
#include "../support/drives.h"
#include "simulation.h"

namespace myolines
{
  namespace
  {
    Muscle3dParameters lengthened_slowly()
    {
      Muscle3dParameters p = test::small_block(2, 3, 0);
      p.dynamic            = false;
      p.activation         = testing::sine(0.3, 10);
      p.boundary           = test::pulled_ends(p, 0.05, 8 / (2 * dealii::numbers::PI));
      return p;
    }

    /// Displacements at all ends of @p n steps to @p end, and the last velocity.
    struct Motion
    {
      std::vector<Vector> u;
      Vector              v;
    };

    Motion motion(const std::string &method, const unsigned int n, const double end = 0.1)
    {
      test::Simulation run(lengthened_slowly());
      Motion           result;
      run.go(method, n, end, [&](const State &state) { result.u.push_back(state.u); });
      result.v = run.state.v;
      return result;
    }

    double difference(const Vector &left, const Vector &right)
    {
      Vector d(left);
      d -= right;
      return d.l2_norm() / right.l2_norm();
    }

    TEST(Equilibria, EndEveryStepOfEveryMethodWithTheirRates)
    {
      const Motion reference = motion("static", 8);
      const double h         = 1e-3;
      Vector       v         = motion("static", 4, 0.1 + h).u.back();
      v -= motion("static", 4, 0.1 - h).u.back();
      v /= 2 * h;
      unsigned int methods = 0;
      for (const IntegratorEntry &entry : integrator_registry())
        {
          if (!entry.make || !entry.facts.dynamic || entry.facts.unknowns == MethodFacts::Unknowns::second_order ||
              entry.facts.name == "newmark")
            continue;
          ++methods;
          const Motion coarse = motion(entry.facts.name, 8), fine = motion(entry.facts.name, 16);
          for (unsigned int i = 1; i < reference.u.size(); ++i)
            EXPECT_LT(difference(coarse.u[i], reference.u[i]), 1e-7) << entry.facts.name << ", step " << i;
          EXPECT_LT(difference(fine.v, v), 0.6 * difference(coarse.v, v)) << entry.facts.name;
          EXPECT_LT(difference(fine.v, v), 0.1) << entry.facts.name;
        }
      EXPECT_GE(methods, 8u);
    }
  } // namespace
} // namespace myolines
