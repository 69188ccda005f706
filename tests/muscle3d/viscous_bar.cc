// SPDX-License-Identifier: LGPL-2.1-or-later
// Newtonian viscosity in motion against closed forms, and the order of every method.
#include "bar.h"

#include <gtest/gtest.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    TissuePart dashpot(const std::string &kind, const std::vector<std::string> &entries)
    {
      std::vector<std::string> all{"type=" + kind};
      all.insert(all.end(), entries.begin(), entries.end());
      const scene::Node node = scene::list_of_defaults(*laws_schema().named(), "dashpot", all);
      for (const LawKind &of_list : law_kinds())
        if (of_list.name == kind)
          return {"dashpot", of_list.make(&node), 1};
      throw std::logic_error("no law " + kind);
    }

    /// A bar of c1, pulled at a constant rate: at constant volume P_11 = 2 c1 (l - l^-2) + (3 eta + eta_f) l-dot/l^2.
    TEST(ViscousBar, PulledSteadilyHasThreeTimesTheViscosity)
    {
      const double       rate = 0.5, end = 0.4, c1 = 2e4, stretch = 1 + rate * end, eta = 2e4, of_fibres = 3e4;
      Muscle3dParameters p       = test::bar({test::condition("symmetry plane", 0)});
      p.dynamic                  = true;
      p.muscle().base            = {1, {c1, 0, 0}};
      p.muscle().bulk_modulus    = 1e9;
      p.muscle().fibre.direction = {{1, 0, 0}};
      p.muscle().laws            = {dashpot("viscosity", {"shear viscosity=2e4"}), dashpot("fibre viscosity", {"viscosity=3e4"})};
      p.boundary.push_back(
          test::condition("formula", 1, {"components=x", "displacement x=0.5*x*t", "velocity x=0.5*x", "acceleration x=0"}, "pulled"));
      p.initial.velocity = std::array<std::string, 3>{{"0.5*x", "-0.25*y", "-0.25*z"}};
      test::Simulation bar(p);
      bar.go("sdirk3", 64, end, [](const State &) {});
      const double expected = 2 * c1 * (stretch - 1 / (stretch * stretch)) + (3 * eta + of_fibres) * rate / (stretch * stretch);
      double       force    = 0;
      for (const Reaction &reaction : measure_reactions(bar.system, bar.state))
        if (reaction.condition == "pulled")
          force = reaction.force[0];
      EXPECT_NEAR(force, 1e-4 * expected, 2e-4 * 1e-4 * expected);
    }

    constexpr double length = 0.03, c1 = 4e4, density = 1060, amplitude = 1e-7, wave = 3.14159265358979324 / 2 / length, end = 0.008;

    /// u_y = amplitude sin(pi x / 2L) q(t), held at x = 0: rho q'' + eta k^2 q' + mu k^2 q = 0, q(0) = 0, q'(0) = 1.
    struct ShearWave
    {
      Muscle3dParameters body() const
      {
        Muscle3dParameters p    = test::small_block(3, 4, 0);
        p.geometry.cells        = {{4, 1, 1}};
        p.activation            = nullptr;
        p.muscle().fibre.sigma0 = 0;
        p.muscle().base         = {1, {c1, 0, 0}};
        p.muscle().bulk_modulus = bulk_modulus;
        p.muscle().laws         = {dashpot("viscosity", {test::set("shear viscosity", eta)})};
        p.boundary              = {test::held(0),        test::held(1, "x z"), test::held(2, "x z"),
                                   test::held(3, "x z"), test::held(4, "x z"), test::held(5, "x z")};
        p.initial.velocity      = std::array<std::string, 3>{{"0", "1e-7*sin(pi/2*x/0.03)", "0"}};
        return p;
      }

      double greatest() const { return amplitude / std::sqrt(2 * c1 * wave * wave / density); }

      /// At the end, over the greatest displacement.
      double error(const test::Simulation &run) const
      {
        const double decay = eta * wave * wave / (2 * density), omega = std::sqrt(2 * c1 * wave * wave / density - decay * decay);
        const double exact = amplitude * std::exp(-decay * end) * std::sin(omega * end) / omega;
        return std::abs(test::displacement(run, test::corner)[1] - exact) / greatest();
      }

      double error(const std::string &method, const unsigned int steps) const
      {
        test::Simulation bar(body(), {"relative tolerance=1e-11"});
        bar.go(method, steps, end, [](const State &) {});
        return error(bar);
      }

      double eta = 100, bulk_modulus = 1e7;
    };

    TEST(ViscousBar, RingsAsInClosedFormWithTheOrderOfEveryMethod)
    {
      unsigned int tried = 0;
      for (const IntegratorEntry &entry : integrator_registry())
        {
          if (!entry.facts.dynamic || entry.make_self_paced)
            continue;
          SCOPED_TRACE(entry.facts.name);
          // explicit steps follow the fastest wave and the stiffest dashpot of the mesh
          const bool         explicit_steps = entry.facts.solves == MethodFacts::Solves::mass;
          const ShearWave    bar            = explicit_steps ? ShearWave{20, 1e5} : ShearWave{};
          const unsigned int steps          = explicit_steps ? 640 : 32;
          const double       coarse = bar.error(entry.facts.name, steps), fine = bar.error(entry.facts.name, 2 * steps);
          EXPECT_LT(fine, entry.facts.order == 1 ? 0.1 : 2e-3);
          EXPECT_GT(std::log2(coarse / fine), entry.facts.order - 0.25) << coarse << " " << fine;
          ++tried;
        }
      EXPECT_GE(tried, 11u);
    }

    /// Methods that choose their steps have no order in these: their errors follow the tolerance.
    TEST(ViscousBar, RingsWithinTheToleranceOfMethodsThatChooseTheirSteps)
    {
      unsigned int tried = 0;
      for (const IntegratorEntry &entry : integrator_registry())
        {
          if (!entry.make_self_paced)
            continue;
          SCOPED_TRACE(entry.facts.name);
          const ShearWave wave_of;
          double          errors[2];
          for (const int i : {0, 1})
            {
              const double     tolerance = i == 0 ? 1e-3 : 1e-5;
              test::Simulation bar(wave_of.body(), {"relative tolerance=1e-11"});
              bar.go_within(entry, tolerance * wave_of.greatest(), tolerance * amplitude, end);
              errors[i] = wave_of.error(bar);
              EXPECT_LT(errors[i], 20 * tolerance);
            }
          EXPECT_LT(errors[1], errors[0] / 5);
          ++tried;
        }
      EXPECT_GE(tried, 3u);
    }
  } // namespace
} // namespace myolines
