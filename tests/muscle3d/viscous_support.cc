// SPDX-License-Identifier: LGPL-2.1-or-later
// Springs and dashpots at a face, against closed forms: a damped oscillator, and waves that a bar sends into its end.
#include "../support/complaint.h"
#include "bar.h"

namespace myolines
{
  namespace
  {
    using test::condition;
    using test::held;
    using test::set;

    /// A passive block between planes that keep its width: it stretches and shears along x only.
    Muscle3dParameters between_planes(const unsigned int degree, const unsigned int cells)
    {
      Muscle3dParameters p    = test::small_block(degree, degree + 1, 0);
      p.geometry.cells        = {{cells, 1, 1}};
      p.activation            = nullptr;
      p.muscle().fibre.sigma0 = 0;
      p.boundary              = {held(2, "y z"), held(3, "y z"), held(4, "y z"), held(5, "y z")};
      return p;
    }

    /// Of small strains along x with nothing across [Pa].
    double wave_modulus(const TissueParameters &tissue) { return tissue.bulk_modulus + 8. / 3 * tissue.base.scale * tissue.base.c[0]; }

    /// One cell of degree one, held at x-, on springs and dashpots at x+, whose face moves as one:
    /// m q'' + c q' + k q = 0, q(0) = 0, q'(0) = speed.
    struct Oscillator
    {
      Oscillator()
      {
        p = between_planes(1, 1);
        p.boundary.insert(p.boundary.end(),
                          {held(0, "x"), condition("isotonic", 1, {"force=0"}),
                           condition("viscous support", 1, {set("normal stiffness", 2e7), set("normal damping", damping)})});
        p.initial.velocity = std::array<std::string, 3>{{std::to_string(speed / length) + "*x", "0", "0"}};
        const double area = 1e-4, k = area * (2e7 + wave_modulus(p.muscle()) / length), c = area * damping,
                     m = p.muscle().density * area * length / 3;
        decay          = c / (2 * m);
        frequency      = std::sqrt(k / m - decay * decay);
      }
      double q(const double t) const { return speed / frequency * std::exp(-decay * t) * std::sin(frequency * t); }
      double rate(const double t) const { return speed * std::exp(-decay * t) * std::cos(frequency * t) - decay * q(t); }

      static constexpr double length = 0.03, damping = 1e4, speed = 3e-5; // strains of 1e-7: no square of them is seen
      Muscle3dParameters      p;
      double                  decay, frequency;
    };

    class ViscousSupportBy : public ::testing::TestWithParam<IntegratorEntry>
    {
    };

    TEST_P(ViscousSupportBy, KeepsTheOrderOfTheMethod)
    {
      const Oscillator   exact;
      const MethodFacts &facts = GetParam().facts;
      const double       end   = 2 / exact.frequency;
      const auto         error = [&](const unsigned int steps) {
        test::Simulation run(exact.p, {"relative tolerance=1e-8"});
        run.go(facts.name, steps, end, [](const State &) {});
        const auto   node = run.system.discretisation().space->face_nodes(1).front();
        const double u    = exact.frequency * (run.state.u(3 * node) - exact.q(end)) / exact.speed,
                     v    = (run.state.v(3 * node) - exact.rate(end)) / exact.speed;
        return std::hypot(u, v);
      };
      const unsigned int n      = facts.order == 1 ? 80 : facts.order == 2 ? 24 : 8;
      const double       coarse = error(n), fine = error(2 * n);
      EXPECT_LT(coarse, 0.05);
      EXPECT_GT(std::log2(coarse / fine), facts.order - 0.3) << coarse << " " << fine;
    }

    TEST(ViscousSupport, StaysWithinTheToleranceOfMethodsThatChooseTheirSteps)
    {
      const Oscillator exact;
      const double     end = 2 / exact.frequency;
      for (const IntegratorEntry &entry : integrator_registry())
        if (entry.make_self_paced)
          for (const double tolerance : {1e-3, 1e-5})
            {
              test::Simulation run(exact.p, {"relative tolerance=1e-8"});
              run.go_within(entry, tolerance * exact.speed / exact.frequency, tolerance * exact.speed, end);
              const auto   node = run.system.discretisation().space->face_nodes(1).front();
              const double u    = exact.frequency * (run.state.u(3 * node) - exact.q(end)) / exact.speed,
                           v    = (run.state.v(3 * node) - exact.rate(end)) / exact.speed;
              EXPECT_LT(std::hypot(u, v), 20 * tolerance) << entry.facts.name;
            }
    }

    /// But those that solve with the mass alone: with one unknown their estimate of the stable step does not converge beyond rounding.
    std::vector<IntegratorEntry> dynamic_methods()
    {
      std::vector<IntegratorEntry> methods;
      for (const IntegratorEntry &entry : integrator_registry())
        if (entry.facts.dynamic && entry.make && entry.facts.solves != MethodFacts::Solves::mass)
          methods.push_back(entry);
      return methods;
    }

    INSTANTIATE_TEST_SUITE_P(Methods, ViscousSupportBy, ::testing::ValuesIn(dynamic_methods()), [](const auto &info) {
      std::string name = info.param.facts.name;
      for (char &c : name)
        c = std::isalnum(c) ? c : '_';
      return name;
    });

    /// A wave with impedance Z = sqrt(rho M) comes back from dashpots d with the part (Z - d)/(Z + d) of its velocity; Lysmer and
    /// Kuhlemeyer, doi:10.1061/JMCEA3.0001144, for d = Z.
    TEST(ViscousSupport, ReflectsAWaveByItsImpedance)
    {
      for (const double part : {0., 0.3, 1., 4.})
        {
          Muscle3dParameters p = between_planes(2, 40);
          p.geometry.size      = {{0.4, 0.01, 0.01}};
          const double rho = p.muscle().density, M = wave_modulus(p.muscle()), c = std::sqrt(M / rho);
          if (part > 0)
            p.boundary.push_back(condition("viscous support", 1, {set("normal damping", part * std::sqrt(rho * M))}));
          // u = f(x - c t), to the right alone, its middle at 0.2 m
          const std::string f = "1e-9*exp(-((x-0.2)/0.03)^2)", slope = "(-2*(x-0.2)/0.03^2)*" + f;
          p.initial.displacement = std::array<std::string, 3>{{f, "0", "0"}};
          p.initial.velocity     = std::array<std::string, 3>{{std::to_string(-c) + "*" + slope, "0", "0"}};
          test::Simulation run(p);
          const auto       energy = [&] { return measure_body(run.system, run.state, SlabRule::quadrature_points).kinetic; };
          const double     before = energy();
          run.go("newmark", 160, 0.4 / c, [](const State &) {}); // to the end and back to the middle
          const double r = (1 - part) / (1 + part);
          EXPECT_NEAR(energy() / before, r * r, 5e-3) << part;
        }
    }

    TEST(ViscousSupport, TellsWhatItTakesFromTheBody)
    {
      Oscillator          bar;
      const BoundaryFacts facts = bar.p.boundary.back()->facts();
      EXPECT_EQ(facts.says_spring, "stands on springs and dashpots");
      test::Simulation run(bar.p);
      const auto       reactions = measure_reactions(run.system, run.state);
      EXPECT_NEAR(reactions.back().force[0], -1e-4 * Oscillator::damping * Oscillator::speed, 1e-15);
      EXPECT_NEAR(measure_powers(run.system, run.state).dissipation, 1e-4 * Oscillator::damping * Oscillator::speed * Oscillator::speed,
                  1e-20);
    }

    TEST(ViscousSupport, RefusesWhatHasNoVelocitiesOrDampsNothing)
    {
      const BoundaryEntry &entry = boundary_entry("viscous support");
      const auto           make  = [&](const std::vector<std::string> &entries, const bool dynamic) {
        return test::complaint([&] {
          entry.make(scene::list_of_defaults(entry.schema, "test", entries), {BoundaryFacts(), Geometry(), LineChoice(), dynamic});
        });
      };
      EXPECT_EQ(make({"normal damping=1"}, true), "");
      EXPECT_NE(make({"normal damping=1"}, false).find("a quasi-static system has no velocities"), std::string::npos);
      EXPECT_NE(make({"normal stiffness=1"}, true).find("nothing damps"), std::string::npos);
      EXPECT_NE(make({"normal damping=-1"}, true), "");
    }
  } // namespace
} // namespace myolines
