// SPDX-License-Identifier: LGPL-2.1-or-later
// What single methods promise beyond the suite: derived values, refusals, boundary jumps.

#include "experiment.h"

#include <myolines/base/error.h>
#include <myolines/time/alpha_method.h>
#include <myolines/time/error_control.h>
#include <myolines/time/start.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  std::unique_ptr<TimeMethod> make(const std::string &method, const Overrides &parameters, const SemiDiscreteSystem &system,
                                   Solvers &solvers, const BoundaryRates rates = BoundaryRates::exact)
  {
    const IntegratorEntry  &entry = integrator_entry(method);
    const IntegratorContext context{system, solvers.nonlinear, rates, solvers.ledger};
    if (entry.make)
      return make_integrator(entry, node(entry.schema, parameters), context);
    return make_self_paced(entry, node(entry.schema, parameters), context, {});
  }

  std::string refusal(const std::string &method, const Overrides &parameters, OscillatorParameters oscillator = {},
                      const BoundaryRates rates = BoundaryRates::exact)
  {
    Solvers                solvers;
    const OscillatorSystem system(std::move(oscillator), solvers.ledger);
    try
      {
        make(method, parameters, system, solvers, rates);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  std::string derived(const std::string &method, const Overrides &parameters)
  {
    const IntegratorEntry &entry = integrator_entry(method);
    std::string            all;
    for (const std::string &line : entry.derived(node(entry.schema, parameters)))
      all += line + "\n";
    return all;
  }

  /// Without inertia, or with unknowns of other orders.
  class Other : public OscillatorSystem
  {
  public:
    Other(WorkLedger &ledger, const bool inertia, std::vector<unsigned int> orders)
      : OscillatorSystem({}, ledger)
      , inertia_(inertia)
      , orders_(std::move(orders))
    {}
    Capabilities capabilities() const override
    {
      Capabilities c = OscillatorSystem::capabilities();
      c.inertia      = inertia_;
      c.orders       = orders_;
      return c;
    }

  private:
    bool                      inertia_;
    std::vector<unsigned int> orders_;
  };
} // namespace

TEST(GeneralizedAlpha, derivesThePublishedCoefficients)
{
  // Chung and Hulbert (1993), equations (25): alpha_m = (2 r - 1)/(r + 1), alpha_f = r/(r + 1)
  const std::string half = derived("generalized alpha", {"spectral radius at infinity=0.5"});
  for (const char *part : {"alpha_m = 0,", "alpha_f = 0.333333333333", "beta = 0.444444444444", "gamma = 0.833333333333", "order 2",
                           "spectral radius at infinity 0.5,"})
    EXPECT_NE(half.find(part), std::string::npos) << part << " in " << half;
  EXPECT_EQ(half, derived("generalized alpha",
                          {"given by=coefficients", "alpha m=1", "alpha f=0.6666666666666667", "convention=jansen whiting hulbert"}));
  EXPECT_EQ(half, derived("generalized alpha", {"given by=coefficients", "alpha m=0", "alpha f=0.3333333333333333"}));
}

TEST(GeneralizedAlpha, refusesCoefficientsThatContradict)
{
  EXPECT_THROW(derived("generalized alpha", {"given by=coefficients", "alpha m=0"}), InputError);
  EXPECT_THROW(derived("generalized alpha", {"given by=coefficients", "alpha m=0", "alpha f=0.3", "spectral radius at infinity=0.5"}),
               InputError);
  EXPECT_NE(refusal("generalized alpha", {"given by=coefficients", "alpha m=0.4", "alpha f=0.3"}).find("unstable"), std::string::npos);
  EXPECT_NE(refusal("generalized alpha", {"given by=coefficients", "alpha m=1", "alpha f=0.6666666666666667"}).find("unstable"),
            std::string::npos)
      << "weights of the end read as weights of the beginning";
  EXPECT_THROW(derived("generalized alpha", {"spectral radius at infinity=1.1"}), InputError);
}

TEST(AlphaFamily, spectralRadiiAtInfinity)
{
  for (const double alpha : {-1. / 3, -0.2, -0.05})
    {
      const double radius = (1 + alpha) / (1 - alpha); // Hilber, Hughes and Taylor
      EXPECT_NEAR(spectral_radius_at_infinity(AlphaCoefficients::second_order(0, -alpha)), radius, 1e-7);
      EXPECT_NEAR(spectral_radius_at_infinity(AlphaCoefficients::second_order(alpha, 0)), radius, 1e-7);
    }
  EXPECT_EQ(spectral_radius_at_infinity({0, 0, 0.25, 0.5}), 1);
  EXPECT_NEAR(spectral_radius_at_infinity({0, 0, 1. / 6, 0.5}), 2 + std::sqrt(3.), 1e-14);
  EXPECT_NE(derived("newmark", {"preset=linear acceleration"}).find("omega dt <= 3.46410161514"), std::string::npos);
  EXPECT_NE(derived("newmark", {"preset=fox goodwin"}).find("omega dt <= 2.44948974278"), std::string::npos);
  EXPECT_NE(derived("newmark", {"preset=central difference"}).find("omega dt <= 2 "), std::string::npos);
  EXPECT_NE(derived("newmark", {"preset=own", "beta=0.4", "gamma=0.7"}).find("order 1"), std::string::npos);
}

TEST(SchemeRates, areRefusedWhereTheyGrowOnMovingBoundaries)
{
  OscillatorParameters moving;
  moving.support = sine(1, 2);
  for (const Overrides &parameters : {Overrides{"preset=linear acceleration"}, Overrides{"preset=fox goodwin"}})
    {
      EXPECT_NE(refusal("newmark", parameters, moving, BoundaryRates::scheme).find("grows without bound"), std::string::npos);
      EXPECT_EQ(refusal("newmark", parameters, moving, BoundaryRates::exact), "");
      EXPECT_EQ(refusal("newmark", parameters, {}, BoundaryRates::scheme), "") << "nothing moves";
    }
  EXPECT_EQ(refusal("newmark", {}, moving, BoundaryRates::scheme), "");
}

TEST(Orders, methodsThatNeedAccelerationsSayWhatTheyDoNotFit)
{
  for (const IntegratorEntry &entry : integrator_registry())
    {
      Solvers     solvers;
      const Other massless(solvers.ledger, false, {2}), mixed(solvers.ledger, true, {0, 1, 2});
      if (entry.facts.unknowns == MethodFacts::Unknowns::every_order_if_damped)
        continue; // without_inertia.cc
      if (entry.facts.unknowns == MethodFacts::Unknowns::every_order)
        {
          EXPECT_NO_THROW(make(entry.facts.name, {}, massless, solvers));
          EXPECT_NO_THROW(make(entry.facts.name, {}, mixed, solvers));
          continue;
        }
      for (const Other *system : {&massless, &mixed})
        try
          {
            make(entry.facts.name, {}, *system, solvers);
            ADD_FAILURE() << entry.facts.name << " accepts a system that it does not fit";
          }
        catch (const InputError &error)
          {
            EXPECT_NE(std::string(error.what()).find(entry.facts.name), std::string::npos);
          }
    }
}

TEST(ExplicitCentralDifference, refusesStepsBeyondTheStableOneWithItsNumber)
{
  // (w dt)^2 + 8 xi w dt = 4 at w = 10, 2 xi w = 15: dt = 2/(15 + sqrt(15^2 + 10^2)); the estimate is a percent below
  OscillatorParameters parameters;
  parameters.stiffness = 100;
  parameters.damping   = 15;
  const double stable  = 2 / (15 + std::sqrt(325.));
  for (const double part : {0.97, 1.01})
    {
      Experiment experiment(integrator_entry("explicit central difference"), parameters, BoundaryRates::exact, {"safety=1"});
      experiment.integrator->start(experiment.state);
      const StepReport report = experiment.integrator->step(part * stable, experiment.state);
      EXPECT_EQ(report.accepted(), part < 1);
      if (part > 1)
        {
          EXPECT_NE(report.reason.find("0.060"), std::string::npos) << report.reason;
        }
      EXPECT_EQ(experiment.solvers.ledger.counted("stable step estimates"), 1u);
    }
}

TEST(ExplicitCentralDifference, itsStabilityLimitIsSharp)
{
  for (const double part : {0.999, 1.001})
    {
      OscillatorParameters parameters;
      parameters.stiffness = 100;
      parameters.damping   = 15;
      Experiment run(integrator_entry("explicit central difference"), parameters, BoundaryRates::exact,
                     {"safety=1", "estimate interval=1000000"});
      run.integrator->start(run.state);
      const double dt = part * 2 / (15 + std::sqrt(325.));
      Archive      archive;
      run.integrator->save(archive);
      archive.put("stable step", 1.); // beyond what it would allow itself
      archive.put("steps since the estimate", 0.);
      run.integrator->load(archive);
      for (unsigned int i = 0; i < 20000; ++i)
        ASSERT_TRUE(run.integrator->step(dt, run.state).accepted());
      EXPECT_EQ(std::abs(run.state.v(0)) < 1, part < 1);
    }
}

TEST(Start, accelerationsAreConsistentWhereAMethodBeginsFromThem)
{
  // m a = f - k u - c (v - s') at t = 0
  OscillatorParameters parameters;
  parameters.mass     = 2;
  parameters.damping  = 0.5;
  parameters.velocity = 3;
  parameters.support  = sine(1, 4);
  parameters.force    = std::make_shared<SmoothDrive>([](double) { return 7.; }, [](double) { return 0.; }, [](double) { return 0.; });
  for (const char *method :
       {"newmark", "hht alpha", "wbz alpha", "generalized alpha", "wilson theta", "tr-bdf2", "explicit central difference"})
    {
      const bool always = std::string(method) == "explicit central difference";
      Experiment experiment(integrator_entry(method), parameters, BoundaryRates::exact, always ? Overrides{} : Overrides{"first step=own"});
      experiment.integrator->start(experiment.state);
      EXPECT_NEAR(experiment.state.a(0), (7 - 1 - 0.5 * (3 - 4)) / 2, 1e-14) << method;
      EXPECT_EQ(experiment.state.a(1), 0) << method;
    }
}

TEST(Start, aBoundaryStartsFromRestOrWithItsVelocity)
{
  OscillatorParameters parameters;
  parameters.support = sine(1, 4);
  Solvers                solvers;
  const OscillatorSystem system(parameters, solvers.ledger);
  using R = BoundaryRates;
  using S = StartVelocity;
  EXPECT_EQ(starting_state(system, 0, R::scheme, S::impulse).v(1), 0);
  EXPECT_EQ(starting_state(system, 0, R::scheme, S::consistent).v(1), 4);
  EXPECT_EQ(starting_state(system, 0, R::exact, S::consistent).v(1), 4);
  EXPECT_EQ(starting_state(system, 0, R::exact, S::impulse).v(1), 0) << "the start of the first piece takes the jump";
}

namespace
{
  /// A first step of third order, whose acceleration goes on, costs a method of fourth order no order.
  TEST(RungeKutta, FourthOrderSurvivesAnLStableFirstStep)
  {
    const auto error = [](const double step) {
      Experiment run(integrator_entry("runge kutta"), {}, BoundaryRates::exact, {"table=esdirk4"});
      run.state.u = 1;
      run.run(1.5, step);
      return std::hypot(run.state.u(0) - std::cos(1.5), run.state.v(0) + std::sin(1.5));
    };
    EXPECT_GT(std::log2(error(1.5 / 20) / error(1.5 / 40)), 3.8);
    EXPECT_GT(std::log2(error(1.5 / 40) / error(1.5 / 80)), 3.8);
  }

  /// What a stage beyond the step meets is none of its business where loads change in between.
  TEST(RungeKutta, NothingMovesBeforeItsBoundary)
  {
    OscillatorParameters parameters;
    parameters.support = std::make_shared<Ramp>(0.3, 2);
    for (const double end : {0.2, 0.3})
      {
        Experiment run(integrator_entry("runge kutta"), parameters, BoundaryRates::exact,
                       {"table=own", "A=1.7071067811865476; -0.7071067811865476 1.7071067811865476"});
        run.state.u = 0;
        run.run(end, 0.1);
        for (const Vector *x : {&run.state.u, &run.state.v, &run.state.a})
          EXPECT_EQ((*x)(0), 0) << end;
        run.run(0.4, 0.1);
        EXPECT_GT(run.state.v(0), 1e-3) << "and then it does";
      }
  }

  TEST(RungeKutta, TablesOfAScenesAreLookedAt)
  {
    EXPECT_NE(
        derived("runge kutta", {}).find("order 3 (conditions up to order 4 are looked at), stages of order 2, embedded formula of order 2"),
        std::string::npos)
        << derived("runge kutta", {});
    EXPECT_NE(derived("runge kutta", {"table=esdirk4"}).find("order 4"), std::string::npos);
    EXPECT_NE(derived("runge kutta", {"table=esdirk4"}).find("L-stable, spectral radius at infinity 0"), std::string::npos);
    const std::string trapezoidal = derived("runge kutta", {"table=own", "A=0; 1/2 1/2"});
    EXPECT_NE(trapezoidal.find("order 2"), std::string::npos);
    EXPECT_NE(trapezoidal.find("stiffly accurate, A-stable, spectral radius at infinity 1"), std::string::npos) << trapezoidal;
    for (const char *part : {"order conditions: sum b = 1, b c = 1/2; of the next order: b c^2 = 0.5, not 1/3, b A c = 0.25, not 1/6",
                             "R(z) = (1 + 0.5 z) / (1 - 0.5 z)"})
      EXPECT_NE(trapezoidal.find(part), std::string::npos) << part << " in " << trapezoidal;
    EXPECT_NE(derived("runge kutta", {"table=own", "A=1"}).find("R(z) = (1) / (1 - 1 z)"), std::string::npos);
    // Alexander's two stages: (1 + (1 - 2 g) z)/(1 - g z)^2, g = 1 - 1/sqrt(2)
    const std::string alexander = derived("runge kutta", {"table=own", "A=0.292893218813; 0.707106781187 0.292893218813"});
    EXPECT_NE(alexander.find("L-stable"), std::string::npos) << alexander;
    EXPECT_NE(alexander.find("R(z) = (1 + 0.414214 z) / (1 - 0.585786 z + 0.0857864 z^2)"), std::string::npos) << alexander;
    EXPECT_NE(derived("runge kutta", {"table=own", "A=0.1; 0.9 0.1"}).find("not A-stable"), std::string::npos);
    EXPECT_EQ(derived("runge kutta", {"table=own", "A=0; 1/2 1/2", "b=0.5 0.5"}), trapezoidal);
    EXPECT_NE(refusal("runge kutta", {"table=own"}).find("there are no coefficients"), std::string::npos);
    EXPECT_NE(refusal("runge kutta", {"table=own", "A=0; 1 0"}).find("the diagonal of row 2 is 0"), std::string::npos);
    EXPECT_NE(refusal("runge kutta", {"table=own", "A=1/2; 1/2 1/2", "b=1/4 3/4"}).find("weight 1 is 0.25"), std::string::npos);
    EXPECT_NE(refusal("runge kutta", {"table=own", "A=0", "b=1"}).find("there is no implicit stage"), std::string::npos);
    EXPECT_NE(refusal("runge kutta", {"b=1"}).find("is not looked at"), std::string::npos);
    EXPECT_NE(refusal("runge kutta", {"table=own", "A=0; 1/4"}).find("row 2 has 1 coefficients"), std::string::npos);
    EXPECT_NE(refusal("runge kutta", {"table=own", "A=0; 1/2 1/4"}).find("adds up to 0.75"), std::string::npos);
    EXPECT_NE(refusal("runge kutta", {"table=own", "A=0; x 1/2"}).find("\"x\" is no coefficient"), std::string::npos);
    EXPECT_NE(refusal("runge kutta", {"table=own", "A=0; 1/2 1/2", "embedded=1"}).find("1 weights that add up to 1"), std::string::npos);
    EXPECT_NE(refusal("runge kutta", {"A=0; 1/2 1/2"}).find("is not looked at"), std::string::npos);
  }
} // namespace
