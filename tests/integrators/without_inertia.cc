// SPDX-License-Identifier: LGPL-2.1-or-later
// Systems without inertia: a viscous one, whose rate its equation gives, and one of equilibria, whose rate nothing gives.

#include "../support/matrices.h"
#include "experiment.h"

#include <myolines/system/band_linearisation.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  double u_exact(const double t) { return std::sin(2 * t) + 0.5 * t; }
  double v_exact(const double t) { return 2 * std::cos(2 * t) + 0.5; }

  /// c (1 + u^2) v + u + u^3 = f(t) with f such that u = u_exact(t); c = 0: equilibria. Begins with a wrong rate.
  class Massless : public SemiDiscreteSystem
  {
  public:
    Massless(const double c, WorkLedger &ledger)
      : c_(c)
      , ledger_(ledger)
    {}

    Capabilities capabilities() const override
    {
      Capabilities capabilities;
      capabilities.inertia = false;
      capabilities.rates   = c_ != 0;
      capabilities.orders  = {order()};
      return capabilities;
    }
    std::size_t n_unknowns() const override { return 1; }
    State       initial_state(double t0) const override
    {
      State state{t0, serial_vector(1), serial_vector(1), serial_vector(1)};
      state.u(0) = u_exact(t0);
      state.v(0) = -7;
      return state;
    }
    const Constraints &constraints() const override { return none_; }
    void               prescribed(double, Side, State &) const override {}
    Evaluation         residual(const Point &p, Vector &r) const override
    {
      r(0) = force(p.u(0), p.v(0)) - force(u_exact(p.t), v_exact(p.t));
      return {};
    }
    std::unique_ptr<Linearisation> make_linearisation() const override
    {
      return std::make_unique<StoredBands>(std::vector<unsigned int>{order()}, 0, std::vector<unsigned int>{}, ledger_);
    }
    void linearise(const Point &p, Linearisation &linearisation) const override
    {
      auto &bands = dynamic_cast<StoredBands &>(linearisation);
      bands.begin();
      bands.stiffness(0, 0) = 2 * c_ * p.u(0) * p.v(0) + 1 + 3 * p.u(0) * p.u(0);
      bands.damping(0, 0)   = c_ * (1 + p.u(0) * p.u(0));
    }
    std::vector<double> events(double, double) const override { return {}; }

  private:
    unsigned int order() const { return c_ != 0 ? 1 : 0; }
    double       force(const double u, const double v) const { return c_ * (1 + u * u) * v + u + u * u * u; }

    const double c_;
    WorkLedger  &ledger_;
    Constraints  none_;
  };

  struct Errors
  {
    double u, v;  ///< at t = 1
    double worst; ///< of u, at all ends of steps
  };

  Errors errors(const IntegratorEntry &entry, const double c, const unsigned int n, const Overrides &method = {})
  {
    Solvers        solvers({"relative tolerance=1e-13", "absolute tolerance=0"});
    const Massless system(c, solvers.ledger);
    const auto     integrator =
        entry.make(node(entry.schema, method), IntegratorContext{system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
    State  state = system.initial_state(0);
    double worst = 0;
    integrator->start(state);
    for (unsigned int i = 0; i < n; ++i)
      {
        const StepReport report = integrator->step(1. / n, state);
        EXPECT_TRUE(report.accepted()) << report.reason;
        worst = std::max(worst, std::abs(state.u(0) - u_exact(state.t)));
      }
    return {state.u(0) - u_exact(1), state.v(0) - v_exact(1), worst};
  }

  class WithoutInertia : public ::testing::TestWithParam<IntegratorEntry>
  {
  public:
    /// Stages leave an error of first order in the rates of an equilibrium, but where the last row of A^-1 takes c^2 to 2.
    unsigned int order_of_equilibrium_rates() const
    {
      const std::string &name = GetParam().facts.name;
      return name == "backward euler" || name == "sdirk2" || name == "sdirk3" ? 1 : 2;
    }
  };

  std::vector<IntegratorEntry> methods_without_inertia()
  {
    std::vector<IntegratorEntry> methods;
    for (const IntegratorEntry &entry : integrator_registry())
      if (entry.make && entry.facts.dynamic && entry.facts.unknowns != MethodFacts::Unknowns::second_order && entry.facts.name != "newmark")
        methods.push_back(entry);
    return methods;
  }
} // namespace

TEST_P(WithoutInertia, aViscousSystemIsIntegratedWithTheOrderOfTheMethod)
{
  const unsigned int n      = GetParam().facts.order == 3 ? 40 : 160;
  const Errors       coarse = errors(GetParam(), 0.3, n), fine = errors(GetParam(), 0.3, 2 * n);
  EXPECT_NEAR(std::log2(coarse.u / fine.u), GetParam().facts.order, 0.15);
  EXPECT_NEAR(std::log2(coarse.v / fine.v), GetParam().facts.order, 0.15);
}

TEST_P(WithoutInertia, everyStepEndsInEquilibriumAndRatesConverge)
{
  const Errors coarse = errors(GetParam(), 0, 160), fine = errors(GetParam(), 0, 320);
  EXPECT_LT(coarse.worst, 1e-12);
  EXPECT_NEAR(std::log2(coarse.v / fine.v), order_of_equilibrium_rates(), 0.15);
}

INSTANTIATE_TEST_SUITE_P(registry, WithoutInertia, ::testing::ValuesIn(methods_without_inertia()), [](const auto &info) {
  std::string name = info.param.facts.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// Accelerations that no inertia gives must fade from step to step: Newmark's formulas do so with gamma > 1/2 only.
TEST(Accelerations, mustFadeWhereThereIsNoInertia)
{
  const IntegratorEntry &newmark = integrator_entry("newmark");
  const Overrides        damped{"preset=own", "beta=0.36", "gamma=0.7"};
  EXPECT_LT(errors(newmark, 0, 40, damped).worst, 1e-12);
  EXPECT_NEAR(errors(newmark, 0.3, 80, damped).u / errors(newmark, 0.3, 160, damped).u, 4, 0.2)
      << "accelerations of an instant of their own leave displacements the second order";

  Solvers        solvers;
  const Massless system(0.3, solvers.ledger);
  const auto     complaint = [&](const std::string &method, const Overrides &settings) {
    const IntegratorEntry &entry = integrator_entry(method);
    try
      {
        entry.make(node(entry.schema, settings), IntegratorContext{system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
        return std::string("taken");
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
  };
  EXPECT_NE(complaint("newmark", {}).find("carries accelerations on undamped, but the system has no inertia"), std::string::npos);
  EXPECT_NE(complaint("hht alpha", {"alpha=0"}).find("undamped"), std::string::npos);
  const auto own = [&](const std::string &a) { return complaint("runge kutta", {"table=own", "A=" + a}); };
  EXPECT_NE(own("0; 11/20 9/20").find("velocities grow from step to step, as the system has no inertia"), std::string::npos);
  EXPECT_EQ(own("0; 1/2 1/2"), "taken");
  for (const std::string method : {"hht alpha", "tr-bdf2"})
    EXPECT_NE(complaint(method, {"first step=own"}).find("begins from accelerations, but the system has no inertia"), std::string::npos);
}
