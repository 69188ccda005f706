// SPDX-License-Identifier: LGPL-2.1-or-later
// Every integrator for dynamics runs the muscle, active, with a moving end, and tends to the same motion.
#include "simulation.h"

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    /// height (1 - cos(pi t / 0.1))/2
    class Rise : public Drive
    {
    public:
      explicit Rise(const double height)
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

    Muscle3dParameters stretched_while_active()
    {
      Muscle3dParameters p = test::small_block(2, 3, 0);
      p.activation         = std::make_shared<Rise>(0.5);
      p.boundary           = test::slowly_pulled_ends(p, 0.03);
      return p;
    }

    Vector displacement(const std::string &method, const unsigned int steps)
    {
      test::Simulation run(stretched_while_active());
      run.go(method, steps, 0.1, [](const State &) {});
      return run.state.u;
    }

    TEST(EveryIntegrator, TendsToTheSameMotionOfTheMuscle)
    {
      const Vector reference = displacement("sdirk3", 48);
      for (const IntegratorEntry &entry : integrator_registry())
        {
          if (!entry.facts.dynamic || entry.facts.solves == MethodFacts::Solves::mass || entry.make_self_paced)
            continue;
          // without iteration nothing brings the volume back that a linear extrapolation of large steps has changed
          Vector difference = displacement(entry.facts.name, entry.facts.solves == MethodFacts::Solves::linear_systems ? 200 : 24);
          difference -= reference;
          const double error = difference.l2_norm() / reference.l2_norm();
          EXPECT_LT(error, entry.facts.order == 1 ? 1e-2 : 2e-3) << entry.facts.name;
        }
    }
  } // namespace
} // namespace myolines
