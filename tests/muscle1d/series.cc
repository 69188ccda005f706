// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs against series that an independent program computed, with methods that chose their steps by error.

#include "../support/table.h"
#include "run.h"

#include <myolines/system/drive_types.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  struct Case
  {
    const char *input, *scale, *masses, *method;
    double      end; ///< [s]
  };

  class Units : public ::testing::TestWithParam<Case>
  {
  };

} // namespace

// muscle_tendon_units.csv: ESDIRK4(3), thinned to every 0.1 s; stated errors 5e-7 of stretches, 1e-5 of strain rates, 1.1e-5 of forces.
TEST_P(Units, followTheReference)
{
  const Case          c = GetParam();
  std::vector<Row>    expected;
  std::vector<double> times;
  for (const Row &row : rows("muscle_tendon_units.csv"))
    if (row[0] == c.input && row[1] == c.scale && row[2] == c.masses && number(row, 3) > 0 && number(row, 3) <= c.end + 1e-9)
      {
        expected.push_back(row);
        times.push_back(number(row, 3));
      }
  ASSERT_GE(times.size(), 10u);

  // Without mass the rate has the small jumps of the printed curves, which no step resolves.
  const bool masses = c.masses != std::string("0");

  MuscleRun run(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), unit_settings(c.input, c.scale, c.masses))), c.method,
                tolerances(1e-8, 1e-10, masses));
  auto      row = expected.begin();
  run.go(times, [&](const State &s) {
    const double              tendon    = run.system.tendon_stretch(s.t, s.u);
    const std::vector<double> stretches = run.system.element_stretches(s.u);
    EXPECT_NEAR(run.system.activation(s.t, s.u), number(*row, 4), 1e-7);
    EXPECT_NEAR(run.system.muscle_stretch(s.u), number(*row, 5), 5e-7) << s.t;
    EXPECT_NEAR(run.system.muscle_strain_rate(s.v), number(*row, 6), 1e-5) << s.t;
    EXPECT_NEAR(tendon - 1, number(*row, 7), 1.2e-6) << s.t;
    EXPECT_NEAR(hill::tendon(tendon).value, number(*row, 8), 1.1e-5) << s.t;
    if (run.system.capabilities().inertia)
      {
        EXPECT_NEAR(run.system.element_forces(s.t, s.u, s.v).front(), number(*row, 9), 1.1e-5) << s.t;
        EXPECT_NEAR(stretches.front(), number(*row, 10), 1e-6) << s.t;
        EXPECT_NEAR(stretches.back(), number(*row, 11), 2e-6) << s.t;
      }
    ++row;
  });
}

INSTANTIATE_TEST_SUITE_P(
    all, Units,
    ::testing::Values(Case{"mild", "1", "0", "sdirk3", 3}, Case{"strong", "1", "0", "sdirk3", 3}, Case{"mild", "1", "0", "ida", 3},
                      Case{"strong", "1", "0", "ida", 3}, Case{"mild", "1", "16", "ida", 3}, Case{"strong", "1", "16", "ida", 3},
                      Case{"mild", "10", "16", "ida", 3}, Case{"strong", "10", "16", "ida", 3}, Case{"mild", "1", "64", "ida", 1},
                      Case{"strong", "1", "64", "ida", 1}, Case{"mild", "10", "64", "ida", 1}, Case{"strong", "10", "64", "ida", 1}),
    [](const auto &info) {
      return std::string(info.param.input) + "_scale_" + info.param.scale + "_masses_" + info.param.masses + "_" + info.param.method;
    });

// Fronts leave the tendon's end of the muscle: smaller elements there halve the error at least, lumped or blended. Forces of 256 and 512
// masses, extrapolated.
TEST(Continuum, gradedTowardsTheTendonIsNearerToManyMasses)
{
  const auto errors = [](const std::string &grading, const std::string &mass) {
    Overrides settings = unit_settings("strong", "10", "");
    settings.erase(settings.begin() + 1);
    settings.insert(settings.end(), {"elements=60", "grading=" + grading, "mass=" + mass});
    MuscleRun           run(read_continuum_muscle(node(continuum_muscle_schema(), settings)), "ida", tolerances(1e-6, 1e-9, true));
    std::vector<double> forces;
    run.go({0.02, 0.04}, [&](const State &s) { forces.push_back(hill::tendon(run.system.tendon_stretch(s.t, s.u)).value); });
    return std::vector<double>{std::abs(forces.at(0) - 0.08219), std::abs(forces.at(1) - 0.12608)};
  };
  const auto uniform = errors("1", "lumped");
  for (const std::string mass : {"lumped", "blended"})
    {
      const auto graded = errors("0.2", mass);
      for (const std::size_t i : {0, 1})
        EXPECT_LT(graded[i], 0.5 * uniform[i]) << mass << i;
      EXPECT_LT(graded[0], 2.5e-3);
    }
}

namespace
{
  class Chains : public ::testing::TestWithParam<std::pair<const char *, const char *>>
  {
  };
} // namespace

// isometric_chain.csv: 17 elements from u_i = 1e-4 sin(i^2) m; the instability at 1.15 makes errors grow 20000 times, which shows that
// the reference has the curve of force and velocity as printed, with its jump of 4.7e-7 at rest.
TEST_P(Chains, followTheReference)
{
  std::vector<Row>    expected;
  std::vector<double> times;
  for (const Row &row : rows("isometric_chain.csv"))
    if (row[0] == GetParam().first && row[1] == GetParam().second)
      {
        expected.push_back(row);
        times.push_back(number(row, 2));
      }
  ASSERT_EQ(times.size(), 11u);
  const bool                unstable = std::string(GetParam().first) == "1.15" && std::string(GetParam().second) == "0";
  MuscleRun                 run(read_isometric_chain(node(isometric_chain_schema(), {"stretch=" + std::string(GetParam().first),
                                                                                     "base material fraction=" + std::string(GetParam().second)})),
                                "arkode", unstable ? tolerances(1e-10, 1e-15, false) : tolerances(1e-8, 1e-13, false));
  const std::vector<double> initial = run.system.element_stretches(run.state.u);
  for (unsigned int i = 0; i < 17; ++i)
    EXPECT_NEAR(initial[i], number(expected[0], 3 + i), 6e-10);
  times.erase(times.begin());
  const double tolerance = unstable ? 1e-5 : 1e-6;
  auto         row       = expected.begin();
  run.go(times, [&](const State &s) {
    ++row;
    const std::vector<double> stretches = run.system.element_stretches(s.u);
    for (unsigned int i = 0; i < 17; ++i)
      EXPECT_NEAR(stretches[i], number(*row, 3 + i), tolerance) << "element " << i + 1 << " at " << s.t;
  });
}

INSTANTIATE_TEST_SUITE_P(all, Chains,
                         ::testing::Values(std::make_pair("0.85", "0"), std::make_pair("0.85", "0.0015"), std::make_pair("1.15", "0"),
                                           std::make_pair("1.15", "0.0015"), std::make_pair("1.45", "0"),
                                           std::make_pair("1.45", "0.0015")));

// The two ways to activate are one equation.
TEST(Activation, asAnUnknownAndBeforehandAgree)
{
  const auto end = [](const std::string &way, const std::string &masses) {
    Overrides settings = unit_settings("strong", "1", masses);
    settings.push_back("activation=" + way);
    MuscleRun           run(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), settings)), "sdirk3", tolerances(1e-7, 1e-10, true));
    std::vector<double> result;
    run.go({0.6}, [&](const State &s) {
      result = {run.system.activation(s.t, s.u), run.system.muscle_stretch(s.u), run.system.muscle_strain_rate(s.v)};
    });
    return result;
  };
  for (const std::string masses : {"0", "4"})
    {
      const auto unknown = end("unknown", masses), beforehand = end("beforehand", masses);
      EXPECT_NEAR(unknown[0], beforehand[0], 1e-6);
      EXPECT_NEAR(unknown[1], beforehand[1], 1e-6);
      EXPECT_NEAR(unknown[2], beforehand[2], 2e-5);
    }
}

// Without excitation the activation decays and the equation of the massless muscle becomes algebraic, F_P = F_T: nothing is singular.
TEST(Massless, goesOnWhereTheActivationVanishes)
{
  Muscle1dParameters p = read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), unit_settings("mild", "1", "0")));
  p.activation         = std::make_shared<PiecewiseDrive>(PiecewiseDrive::lines({{0, 0.0329}, {0.2, 0}}));
  MuscleRun run(p, "sdirk3", tolerances(1e-7, 1e-10, false));
  run.go({0.1, 0.5, 1, 2}, [&](const State &s) {
    const double residual =
        p.force(run.system.muscle_stretch(s.u), p.force.maximum_strain_rate * run.system.muscle_strain_rate(s.v), p.activation->value(s.t))
            .force -
        hill::tendon(run.system.tendon_stretch(s.t, s.u)).value;
    EXPECT_NEAR(residual, 0, 1e-6) << s.t;
    if (s.t > 0.3)
      {
        EXPECT_NEAR(hill::passive(run.system.muscle_stretch(s.u)).value, hill::tendon(run.system.tendon_stretch(s.t, s.u)).value, 1e-6);
      }
  });
}

// From the passive balance an active muscle shortens at once: both kinds of methods find the rate with which it begins.
TEST(Massless, startsWithTheRateThatBalances)
{
  for (const std::string method : {"ida", "sdirk3"})
    {
      Overrides settings = unit_settings("mild", "1", "0");
      settings.push_back("initial balance=passive");
      MuscleRun run(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), settings)), method, tolerances(1e-7, 1e-10, false));
      EXPECT_NEAR(run.system.muscle_stretch(run.state.u) * run.system.parameters().optimal_length, 0.280376953310, 2e-12);
      run.go({1e-4, 0.5}, [&](const State &s) {
        EXPECT_LT(s.t < 0.1 ? run.system.muscle_strain_rate(s.v) : -1, -0.005);
        EXPECT_NEAR(run.system.element_forces(s.t, s.u, s.v).front(), hill::tendon(run.system.tendon_stretch(s.t, s.u)).value, 2e-6);
      });
    }
}

// Methods that need accelerations say so.
TEST(Massless, isRefusedByMethodsThatNeedAccelerations)
{
  Solvers              solvers;
  const Muscle1dSystem system(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), {"masses=0"})), solvers.ledger);
  unsigned int         refused = 0;
  for (const IntegratorEntry &entry : integrator_registry())
    if (entry.facts.unknowns == MethodFacts::Unknowns::second_order && entry.make)
      {
        ++refused;
        try
          {
            make_integrator(entry, node(entry.schema), {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
            FAIL() << entry.facts.name;
          }
        catch (const InputError &error)
          {
            EXPECT_NE(std::string(error.what()).find("no inertia"), std::string::npos) << error.what();
          }
      }
  EXPECT_GT(refused, 3u);
}
