// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: with nothing but defaults every method that meets the ends of its steps is right where activation or the velocity of a
// boundary jumps, and a time that is beside a kink by rounding only is the kink.

#include "measured_run.h"

#include <myolines/time/integrator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  std::string type(const std::string &method) { return "integrator/type=" + method; }

  const std::vector<Overrides> &methods()
  {
    const std::string                   radius = "integrator/spectral radius at infinity=";
    static const std::vector<Overrides> all{{type("newmark")},
                                            {type("hht alpha")},
                                            {type("hht alpha"), "integrator/alpha=-0.3"},
                                            {type("wbz alpha"), "integrator/alpha=-0.3"},
                                            {type("generalized alpha"), radius + "0"},
                                            {type("generalized alpha"), radius + "0.5"},
                                            {type("generalized alpha")},
                                            {type("tr-bdf2")},
                                            {type("bdf2")}};
    return all;
  }

  std::string text(const double x)
  {
    std::ostringstream stream;
    stream.precision(17);
    stream << x;
    return stream.str();
  }

  /// One cell, both ends held, activated to one half from 25 ms on within @p width [s].
  Overrides switched_on(const double width)
  {
    return {"system/geometry/refinement=0", "system/activation/points=0 0; 0.025 0; " + text(0.025 + width) + " 0.5; 1 0.5",
            "time/step=0.005", "time/end=0.05"};
  }

  /// One active cell, stretched at once at 0.5 per second.
  Overrides stretched(const std::string &rates)
  {
    return {"system/geometry/refinement=0", "time/boundary rates=" + rates, "time/events=restart", "time/end=0.1"};
  }

  MeasuredRun run(const std::string &scene, Overrides overrides, const Overrides &more)
  {
    overrides.insert(overrides.end(), more.begin(), more.end());
    return measured_run(scene, overrides);
  }

  void expect_as_sdirk3(const std::string &scene, const Overrides &protocol)
  {
    const MeasuredRun reference = run(scene, protocol, {type("sdirk3")});
    for (const Overrides &method : methods())
      {
        const MeasuredRun ours = run(scene, protocol, method);
        EXPECT_LT(relative_error(ours.u, reference.u), 0.03) << method.front() << " " << method.back();
      }
  }
} // namespace

TEST(Kinks, HarmNoMethodWhereMuscleIsSwitchedOnAtOnce)
{
  for (const double width : {1e-9, 1e-3})
    {
      SCOPED_TRACE(width);
      expect_as_sdirk3("isometric_block.xml", switched_on(width));
    }
}

TEST(Kinks, HarmNoMethodWhereABoundaryStartsAtOnce)
{
  for (const char *rates : {"exact", "scheme"})
    {
      SCOPED_TRACE(rates);
      expect_as_sdirk3("kinked_block.xml", stretched(rates));
    }
}

TEST(Kinks, AreWhereATimeIsBesideThemByRoundingOnly)
{
  const double kink = 0.025;
  for (const IntegratorEntry &entry : integrator_registry())
    {
      if (!entry.facts.dynamic || entry.make_self_paced || entry.facts.solves != MethodFacts::Solves::nonlinear_equations)
        continue;
      Overrides plain = switched_on(0.01);
      plain.push_back(type(entry.facts.name));
      const Vector expected = measured_run("isometric_block.xml", plain).u;
      for (const char *events : {"restart", "land"})
        for (const double beside : {std::nextafter(kink, 0.), std::nextafter(kink, 1.)})
          {
            const MeasuredRun ours =
                run("isometric_block.xml", plain, {"time/land on=" + text(beside), std::string("time/events=") + events});
            if (events == std::string("restart"))
              EXPECT_EQ(relative_error(ours.u, expected), 0) << entry.facts.name;
            EXPECT_EQ(ours.mid_velocity.size(), 11u) << entry.facts.name << ": a step between the two";
          }
    }
}
