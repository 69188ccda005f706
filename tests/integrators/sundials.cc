// SPDX-License-Identifier: LGPL-2.1-or-later
// The methods of SUNDIALS: every table has its order, errors follow tolerances, steps stop where they must, failures leave no trace.

#include "exact.h"
#include "experiment.h"

#include <myolines/base/error.h>
#include <myolines/integrators/sundials_arkode_tables.h>
#include <myolines/time/error_control.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  /// A method with parameters.
  struct Method
  {
    std::string label;
    std::string name;
    Overrides   parameters;
  };

  inline void PrintTo(const Method &method, std::ostream *stream) { *stream << method.label; }

  Method arkode(const std::string &implicit, const std::string &explicit_ = "none")
  {
    return {implicit == "none" ? explicit_ : implicit, "arkode", {"implicit table=" + implicit, "explicit table=" + explicit_}};
  }

  std::vector<Method> self_paced_methods()
  {
    return {{"ida", "ida", {}},
            {"cvode", "cvode", {}},
            {"cvode_adams", "cvode", {"formula=adams", "maximum order=12"}},
            {"cvode_adams_fixed_point", "cvode", {"formula=adams", "maximum order=12", "iteration=fixed point"}},
            arkode("ESDIRK325L2SA_5_2_3"),
            arkode("ESDIRK547L2SA_7_4_5"),
            arkode("none", "BOGACKI_SHAMPINE_4_2_3"),
            arkode("none", "DORMAND_PRINCE_7_4_5"),
            arkode("none", "FEHLBERG_13_7_8"),
            {"arkode_own_table",
             "arkode",
             {"implicit table=none", "explicit table=own", "A=0; 1/2 0; 0 3/4 0; 2/9 1/3 4/9 0", "embedded=7/24 1/4 1/3 1/8"}}};
  }

  /// An oscillator with steps that the method chooses.
  struct SelfPaced
  {
    SelfPaced(const Method &method, OscillatorParameters parameters, const double end, const Overrides &settings)
      : time(node(time_schema(), by_error(settings, end)))
      , system(std::move(parameters), solvers.ledger)
      , norm(make_error_norm(time, system))
      , integrator(entry(method).make_self_paced(
            node(entry(method).schema, method.parameters),
            {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger, StartVelocity::consistent, norm.get()},
            error_control_limits(time)))
      , state(system.initial_state(0))
    {}

    static const IntegratorEntry &entry(const Method &method) { return integrator_entry(method.name); }

    void run(const std::vector<Observer *> &observers = {}, Keeper *keeper = nullptr)
    {
      run_loop(system, *integrator, loop_settings(time), state, observers, solvers.ledger, keeper);
    }

    std::uint64_t steps() const { return solvers.ledger.counted("accepted steps"); }

    Solvers                              solvers;
    scene::Node                          time;
    OscillatorSystem                     system;
    std::unique_ptr<ErrorNorm>           norm;
    std::unique_ptr<SelfPacedIntegrator> integrator;
    State                                state;
  };

  Overrides tolerance(const double value)
  {
    std::ostringstream text;
    text << value;
    Overrides settings;
    for (const char *block : {"displacement", "velocity"})
      settings.insert(settings.end(), {std::string("control/") + block + "/relative tolerance=0",
                                       std::string("control/") + block + "/absolute tolerance=" + text.str()});
    return settings;
  }

  struct Times : Observer
  {
    void                accepted(const State &, const StepRecord &record) override { times.push_back(record.t); }
    std::vector<double> times;
  };

  class Sundials : public ::testing::TestWithParam<Method>
  {
  };
} // namespace

TEST_P(Sundials, errorsFollowTheToleranceOverFourDecades)
{
  for (const Problem &problem : problems())
    {
      std::vector<double> steps, errors;
      for (const double tol : {1e-4, 1e-6, 1e-8})
        {
          SelfPaced run(GetParam(), problem.parameters, 10, tolerance(tol));
          run.run();
          EXPECT_EQ(run.state.t, 10);
          steps.push_back(run.steps());
          errors.push_back(std::abs(run.state.u(0) - problem.exact(10).u) + std::abs(run.state.v(0) - problem.exact(10).v));
          EXPECT_LT(errors.back(), 400 * tol) << problem.name << ", " << run.steps() << " steps";
        }
      EXPECT_GT(std::log10(errors[0] / errors[2]), 2.5) << problem.name << ", errors " << ::testing::PrintToString(errors);
      EXPECT_GT(steps[2], steps[0]) << problem.name;
      EXPECT_LT(steps[2], 3e4) << problem.name;
    }
}

TEST_P(Sundials, theAccelerationAtTheEndOfAStepIsThatOfTheEquations)
{
  OscillatorParameters parameters;
  parameters.mass            = 3;
  parameters.cubic_stiffness = 2;
  parameters.damping         = 0.3;
  SelfPaced run(GetParam(), parameters, 1, tolerance(1e-7));
  run.run();
  const double u = run.state.u(0), v = run.state.v(0);
  EXPECT_NEAR(run.state.a(0), -(u + 2 * u * u * u + 0.3 * v) / 3, 1e-4);
}

TEST_P(Sundials, landsOnKinksAndOnTheEnd)
{
  OscillatorParameters parameters;
  parameters.damping = 1;
  parameters.support = std::make_shared<Ramp>(0.3, 2);
  SelfPaced run(GetParam(), parameters, 1, tolerance(1e-6));
  Times     times;
  run.run({&times});
  EXPECT_EQ(std::count(times.times.begin(), times.times.end(), 0.3), 1);
  EXPECT_EQ(run.state.t, 1);
  EXPECT_EQ(run.state.u(1), 1.4);
  EXPECT_EQ(run.state.v(1), 2);
  EXPECT_EQ(run.solvers.ledger.counted("restarts at events"), 1u);
  EXPECT_TRUE(std::is_sorted(times.times.begin(), times.times.end()));
}

TEST_P(Sundials, goesOnFromASavedStateWithinTheTolerance)
{
  struct Save : Keeper
  {
    void accepted(const State &now, const std::size_t step) override
    {
      if (step == 12)
        {
          run->integrator->save(integrator);
          state = now;
        }
    }
    std::optional<std::string> reason_to_stop(const State &, std::size_t) override { return std::nullopt; }
    void                       ended(const State &, std::size_t) override {}
    SelfPaced                 *run = nullptr;
    Archive                    integrator;
    State                      state;
  } save;
  OscillatorParameters parameters;
  parameters.cubic_stiffness = 2;
  SelfPaced whole(GetParam(), parameters, 5, tolerance(1e-6)), resumed(GetParam(), parameters, 5, tolerance(1e-6));
  save.run = &whole;
  whole.run({}, &save);
  ASSERT_GT(save.state.t, 0);
  resumed.state = save.state;
  resumed.integrator->load(save.integrator);
  resumed.run();
  EXPECT_NEAR(resumed.state.u(0), duffing(2, 5).u, 2e-4);
  EXPECT_NEAR(resumed.state.u(0), whole.state.u(0), 2e-4);
}

TEST_P(Sundials, aFailureLeavesTheStateAndSaysWhy)
{
  OscillatorParameters parameters;
  parameters.force   = std::make_shared<SmoothDrive>([](double t) { return t < 0.5 ? 0. : std::numeric_limits<double>::infinity(); },
                                                   [](double) { return 0.; }, [](double) { return 0.; });
  Overrides settings = tolerance(1e-6);
  settings.push_back("control/minimum step=1e-6");
  settings.push_back("control/maximum step=0.1");
  SelfPaced run(GetParam(), parameters, 1, settings);
  run.integrator->start(run.state);
  StepReport          report;
  std::vector<double> before;
  while (report.accepted())
    {
      before = values(run.state);
      report = run.integrator->advance(1, run.state);
    }
  EXPECT_EQ(values(run.state), before);
  EXPECT_FALSE(report.reason.empty());
  EXPECT_GT(run.state.t, 0.3);
  EXPECT_LE(run.state.t, 0.5);
}

INSTANTIATE_TEST_SUITE_P(methods, Sundials, ::testing::ValuesIn(self_paced_methods()), [](const auto &info) { return info.param.label; });

namespace
{
  std::vector<Method> all_tables()
  {
    std::vector<Method> all;
    for (const std::string &name : arkode_implicit_tables())
      all.push_back(arkode(name));
    for (const std::string &name : arkode_explicit_tables())
      all.push_back(arkode("none", name));
    return all;
  }

  class Table : public ::testing::TestWithParam<Method>
  {
  protected:
    static double error(const Problem &problem, const unsigned int n)
    {
      Overrides parameters = GetParam().parameters;
      parameters.push_back("force=true"); // tables that amplify undamped oscillations have no stable step
      Experiment run(integrator_entry("arkode"), problem.parameters, BoundaryRates::exact, parameters);
      run.run(2, 2. / n);
      EXPECT_EQ(run.solvers.ledger.counted("accepted steps"), n);
      return std::hypot(run.state.u(0) - problem.exact(2).u, run.state.v(0) - problem.exact(2).v);
    }
  };
} // namespace

/// The order is the last number of the name; linear problems may show more.
TEST_P(Table, hasItsOrder)
{
  const std::string &label = GetParam().label;
  const int          order = std::stoi(label.substr(label.rfind('_') + 1));
  for (const Problem &problem : problems())
    {
      const unsigned int n    = order >= 7 ? 6 : order >= 5 ? 20 : 40; // errors stay above what Newton's method leaves
      const double       rate = std::log2(error(problem, n) / error(problem, 2 * n));
      EXPECT_GT(rate, order - (order >= 5 ? 0.5 : 0.25)) << problem.name;
      EXPECT_LT(rate, order + 1.5) << problem.name;
    }
}

INSTANTIATE_TEST_SUITE_P(arkode, Table, ::testing::ValuesIn(all_tables()), [](const auto &info) { return info.param.label; });

/// The linear spring implicit, the cubic one explicit.
TEST(Arkode, additiveMethodsHaveTheirOrder)
{
  for (const auto &[implicit, explicit_] : arkode_additive_pairs())
    {
      OscillatorParameters parameters;
      parameters.cubic_stiffness = 2;
      const auto error           = [&, implicit = implicit, explicit_ = explicit_](const unsigned int n) {
        Experiment run(integrator_entry("arkode"), parameters, BoundaryRates::exact,
                                 {"implicit table=" + implicit, "explicit table=" + explicit_, "split=linear"});
        run.run(2, 2. / n);
        return std::hypot(run.state.u(0) - duffing(2, 2).u, run.state.v(0) - duffing(2, 2).v);
      };
      const int    order = std::stoi(implicit.substr(implicit.rfind('_') + 1));
      const double rate  = std::log2(error(40) / error(80));
      EXPECT_GT(rate, order - 0.5) << implicit;
      EXPECT_LT(rate, order + 1.5) << implicit;
    }
}

/// Stability functions 1 + z + z^2/2, which is 1 at z = -2, and that with z^3/6 more: |R(iy)| = 1 at y = sqrt(3).
TEST(Arkode, knowsTheStableStepOfExplicitTables)
{
  ArkodeTables heun, bogacki;
  heun.explicit_    = "HEUN_EULER_2_1_2";
  bogacki.explicit_ = "BOGACKI_SHAMPINE_4_2_3";
  EXPECT_NEAR(heun.stable_step(0, 100), 0.02, 2e-4);
  EXPECT_NEAR(bogacki.stable_step(1e4, 0), std::sqrt(3.) / 100, 2e-4);
  EXPECT_EQ(heun.stable_step(0, 0), std::numeric_limits<double>::infinity());
}

TEST(Arkode, refusesExplicitStepsThatAreNotStable)
{
  OscillatorParameters stiff;
  stiff.stiffness = 1e8; // stable: 1.7e-4 s
  const Method explicit_method{"", "arkode", {"implicit table=none", "explicit table=BOGACKI_SHAMPINE_4_2_3", "most explicit steps=1000"}};
  SelfPaced    adaptive(explicit_method, stiff, 1, tolerance(1e-3));
  try
    {
      adaptive.run();
      ADD_FAILURE() << "needs 5800 steps";
    }
  catch (const SolveError &error)
    {
      EXPECT_NE(std::string(error.what()).find("stable step of this explicit method is about 0.00017"), std::string::npos) << error.what();
    }
  Experiment fixed(integrator_entry("arkode"), stiff, BoundaryRates::exact, explicit_method.parameters);
  fixed.integrator->start(fixed.state);
  EXPECT_FALSE(fixed.integrator->step(2e-4, fixed.state).accepted());
  EXPECT_TRUE(fixed.integrator->step(1.6e-4, fixed.state).accepted());
}

TEST(Arkode, refusesTablesThatDoNotFit)
{
  const IntegratorEntry &entry   = integrator_entry("arkode");
  const auto             refused = [&](const Overrides &parameters) {
    try
      {
        arkode_tables(node(entry.schema, parameters));
        return std::string();
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
  };
  EXPECT_EQ(refused({}), "");
  EXPECT_NE(refused({"implicit table=none"}).find("neither"), std::string::npos);
  EXPECT_NE(refused({"split=linear"}).find("only an additive method"), std::string::npos);
  EXPECT_NE(refused({"explicit table=VERNER_8_5_6", "split=linear"}).find("do not belong together"), std::string::npos);
  EXPECT_NE(refused({"implicit table=ARK324L2SA_DIRK_4_2_3", "explicit table=ARK324L2SA_ERK_4_2_3"}).find("what is implicit"),
            std::string::npos);
  EXPECT_EQ(refused({"implicit table=ARK324L2SA_DIRK_4_2_3", "explicit table=ARK324L2SA_ERK_4_2_3", "split=linear"}), "");
}

TEST(SundialsMethods, refuseBoundariesThatMoveByFormulas)
{
  OscillatorParameters moving;
  moving.support = sine(1, 2);
  for (const char *name : {"ida", "cvode", "arkode"})
    {
      Solvers                solvers;
      const OscillatorSystem system(moving, solvers.ledger);
      const IntegratorEntry &entry = integrator_entry(name);
      EXPECT_THROW(make_self_paced(entry, node(entry.schema), {system, solvers.nonlinear, BoundaryRates::scheme, solvers.ledger}, {}),
                   InputError);
    }
}
