// SPDX-License-Identifier: LGPL-2.1-or-later
// Coefficients of a scene in `arkode`: methods that are explicit or not stiffly accurate have the order that theory says, and `check` tells
// it.

#include "exact.h"
#include "experiment.h"

#include <myolines/base/error.h>
#include <myolines/integrators/sundials_arkode_tables.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  struct OwnTable
  {
    std::string  label;
    unsigned int order;
    Overrides    parameters;
  };

  inline void PrintTo(const OwnTable &table, std::ostream *stream) { *stream << table.label; }

  OwnTable explicit_table(const std::string &label, const unsigned int order, const std::string &a, const std::string &b)
  {
    return {label, order, {"implicit table=none", "explicit table=own", "A=" + a, "b=" + b}};
  }

  OwnTable implicit_table(const std::string &label, const unsigned int order, const std::string &a, const std::string &b)
  {
    return {label, order, {"implicit table=own", "A=" + a, "b=" + b}};
  }

  const OwnTable classical = explicit_table("classical", 4, "0; 1/2 0; 0 1/2 0; 0 0 1 0", "1/6 1/3 1/3 1/6");
  // gamma = (3 + sqrt(3))/6 (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, table II.7.2)
  const OwnTable crouzeix = implicit_table("crouzeix", 3, "0.788675134594812882; -0.577350269189625765 0.788675134594812882", "1/2 1/2");

  std::vector<OwnTable> own_tables()
  {
    return {classical,
            crouzeix,
            explicit_table("heun", 2, "0; 1 0", "1/2 1/2"),
            implicit_table("midpoint", 2, "1/2", "1"),
            implicit_table("trapezoidal", 2, "0; 1/2 1/2", ""),
            implicit_table("explicit_stage_last", 2, "1/2; 1 0", "1 0")};
  }

  class OwnTables : public ::testing::TestWithParam<OwnTable>
  {
  protected:
    static double error(const Problem &problem, const unsigned int n)
    {
      Overrides parameters = GetParam().parameters;
      parameters.push_back("force=true"); // Heun's method amplifies undamped oscillations
      Experiment run(integrator_entry("arkode"), problem.parameters, BoundaryRates::exact, parameters);
      run.run(2, 2. / n);
      return std::hypot(run.state.u(0) - problem.exact(2).u, run.state.v(0) - problem.exact(2).v);
    }
  };

  std::string told(const Overrides &parameters)
  {
    const IntegratorEntry &entry = integrator_entry("arkode");
    std::string            text;
    for (const std::string &line : entry.derived(node(entry.schema, parameters)))
      text += line + "\n";
    return text;
  }

  /// What is said against @p parameters; "" for nothing.
  std::string said_against(const Overrides &parameters)
  {
    try
      {
        arkode_tables(node(integrator_entry("arkode").schema, parameters));
        return "";
      }
    catch (const InputError &error)
      {
        return error.what();
      }
  }
} // namespace

TEST_P(OwnTables, haveTheirOrder)
{
  const IntegratorEntry &entry = integrator_entry("arkode");
  EXPECT_EQ(facts_with(entry, node(entry.schema, GetParam().parameters)).order, GetParam().order);
  EXPECT_EQ(told(GetParam().parameters).rfind("order " + std::to_string(GetParam().order) + ", embedded order 0, ", 0), 0u);
  for (const Problem &problem : problems())
    {
      const double rate = std::log2(error(problem, 40) / error(problem, 80));
      EXPECT_GT(rate, GetParam().order - 0.25) << problem.name;
      EXPECT_LT(rate, GetParam().order + 1.5) << problem.name;
    }
}

INSTANTIATE_TEST_SUITE_P(arkode, OwnTables, ::testing::ValuesIn(own_tables()), [](const auto &info) { return info.param.label; });

TEST(OwnTable, isToldWithItsStabilityFunction)
{
  const std::string explicit_ = told(classical.parameters), implicit = told(crouzeix.parameters);
  for (const char *part : {"not stiffly accurate, not A-stable\n", "R(z) = (1 + 1 z + 0.5 z^2 + 0.166667 z^3 + 0.0416667 z^4)\n"})
    EXPECT_NE(explicit_.find(part), std::string::npos) << explicit_;
  EXPECT_NE(implicit.find("not stiffly accurate, A-stable, spectral radius at infinity 0.732051"), std::string::npos) << implicit;
  Overrides with_estimate = classical.parameters;
  with_estimate.push_back("embedded=0 1 0 0"); // the explicit midpoint rule
  EXPECT_NE(told(with_estimate).find("order 4, embedded order 2, 4 stages"), std::string::npos);
}

/// Ten steps of the trapezoidal rule in one: the coefficients of the highest powers are small, and yet there.
TEST(OwnTable, keepsSmallCoefficientsOfItsStabilityFunction)
{
  std::string a = "0", row = "1/20";
  for (unsigned int i = 0; i < 10; ++i, row += " 1/10")
    a += "; " + row + " 1/20";
  const std::string text = told({"implicit table=own", "A=" + a});
  for (const char *part : {"stiffly accurate, A-stable, spectral radius at infinity 1\n", "9.76563e-14 z^10) / (", "9.76563e-14 z^10)\n"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

/// The formulas of the method, one after the other.
TEST(OwnTable, isTheMethodOfItsCoefficients)
{
  OscillatorParameters parameters;
  parameters.cubic_stiffness = 2;
  Experiment   run(integrator_entry("arkode"), parameters, BoundaryRates::exact, classical.parameters);
  const double u0 = run.state.u(0), v0 = run.state.v(0), dt = 0.1;
  const auto   acceleration = [&](const double u, const double v) {
    return -(parameters.damping * v + parameters.stiffness * u + parameters.cubic_stiffness * u * u * u) / parameters.mass;
  };
  double u = u0, v = v0, sum_u = 0, sum_v = 0;
  for (const auto &[part, weight] : {std::pair(0.5, 1.), {0.5, 2.}, {1., 2.}, {0., 1.}}) // to the next stage, of this one
    {
      const double slope_u = v, slope_v = acceleration(u, v);
      sum_u += weight / 6 * slope_u;
      sum_v += weight / 6 * slope_v;
      u = u0 + part * dt * slope_u;
      v = v0 + part * dt * slope_v;
    }
  run.run(dt, dt);
  EXPECT_NEAR(run.state.u(0), u0 + dt * sum_u, 1e-15);
  EXPECT_NEAR(run.state.v(0), v0 + dt * sum_v, 1e-15);
}

TEST(OwnTable, isRefusedWhereItIsNone)
{
  const auto expect = [](const Overrides &parameters, const std::string &words) {
    EXPECT_NE(said_against(parameters).find(words), std::string::npos) << said_against(parameters);
  };
  expect({"A=1/2", "b=1"}, "is not looked at");
  expect({"implicit table=own"}, "there are no coefficients");
  expect({"implicit table=own", "A=0; 1 0", "b=1/2 1/2"}, "there is no implicit stage");
  expect({"implicit table=own", "A=-1/2", "b=1"}, "the diagonal of row 1 is -0.5");
  expect({"implicit table=none", "explicit table=own", "A=0; 1/2 1/2"}, "the diagonal of row 2 is 0.5");
  expect({"implicit table=own", "A=1/2", "b=1/2 1/2"}, "2 weights that add up to 1");
  expect({"implicit table=own", "A=1/2; 1/2 1/2", "embedded=1/2 1/2"}, "the estimated error is always 0");
  expect({"implicit table=own", "A=1"}, "the method is of order 1");
  expect({"implicit table=none", "explicit table=own", "A=0; 1 0", "b=1 0"}, "the method is of order 1");
  expect({"implicit table=own", "explicit table=HEUN_EULER_2_1_2", "A=1/2", "b=1", "split=linear"}, "do not belong together");
}

TEST(OwnTable, withoutEmbeddedFormulaChoosesNoSteps)
{
  const IntegratorEntry &entry = integrator_entry("arkode");
  Solvers                solvers;
  const OscillatorSystem system({}, solvers.ledger);
  EXPECT_THROW(entry.make_self_paced(node(entry.schema, classical.parameters),
                                     {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger}, {}),
               InputError);
}
