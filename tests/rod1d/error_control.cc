// SPDX-License-Identifier: LGPL-2.1-or-later
// Steps chosen by error on the rod of the thesis.

#include "../support/solvers.h"

#include <myolines/rod1d/rod1d_system.h>
#include <myolines/system/drive_types.h>
#include <myolines/time/error_control.h>
#include <myolines/time/loop.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  Rod1dParameters neo_hookean(const unsigned int elements, std::shared_ptr<const Drive> strain)
  {
    Rod1dParameters parameters =
        read_rod1d(node(rod1d_schema(), {"length=0.1", "elements=" + std::to_string(elements), "material/type=neo-hookean",
                                         "material/bulk modulus=1e6", "material/poisson ratio=0.4", "material/lame parameters=thesis",
                                         "profile/type=sine", "profile/amplitude=0.1", "profile/frequency=1"}));
    if (strain)
      parameters.strain = std::move(strain);
    return parameters;
  }

  struct AdaptiveRod
  {
    AdaptiveRod(Rod1dParameters parameters, const std::string &method, const Overrides &settings)
      : time(node(time_schema(), with_control(settings)))
      , system(std::move(parameters), solvers.ledger)
      , norm(make_error_norm(time, system))
      , entry(integrator_entry(method))
      , control(make_step_control(time, error_exponent(entry.facts)))
      , integrator(
            make_integrator(entry, node(entry.schema),
                            {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger, StartVelocity::consistent, norm.get()}))
      , state(system.initial_state(0))
    {
      run_loop(system, *integrator, *control, loop_settings(time), state, {}, solvers.ledger);
    }

    static Overrides with_control(Overrides settings)
    {
      settings.push_back("control/type=error");
      return settings;
    }

    double counted(const char *what) const { return solvers.ledger.counted(what); }

    Solvers                      solvers;
    scene::Node                  time;
    Rod1dSystem                  system;
    std::unique_ptr<ErrorNorm>   norm;
    const IntegratorEntry       &entry;
    std::unique_ptr<StepControl> control;
    std::unique_ptr<Integrator>  integrator;
    State                        state;
  };
} // namespace

TEST(RodByError, sinusoidalPullOfTable42)
{
  // Table 4.2 of the thesis, L/64: ode23tb, which is TR-BDF2, with RelTol 1e-2 and AbsTol 1e-4 takes steps of 4.25e-5 s on average; an
  // adaptive TR-BDF2 of others 10,843.
  const AdaptiveRod run(neo_hookean(64, nullptr), "tr-bdf2",
                        {"end=1", "step=1e-5", "control/displacement/relative tolerance=1e-2",
                         "control/displacement/absolute tolerance=1e-4", "control/velocity/relative tolerance=1e-2",
                         "control/velocity/absolute tolerance=1e-4"});
  const double      steps = run.counted("accepted steps") + run.counted("rejected steps");
  EXPECT_LT(steps, 11000);
  EXPECT_GT(steps, 500) << "there are waves to follow";
  EXPECT_LT(run.counted("preconditioner set-ups"), 8 * steps);
  EXPECT_LT(run.state.u.linfty_norm(), 1e-3) << "back at rest length up to waves";
}

TEST(RodByError, workIsInProportionToTheTolerance)
{
  for (const IntegratorEntry &entry : integrator_registry())
    {
      if (!entry.facts.dynamic || entry.facts.solves == MethodFacts::Solves::mass || entry.make_self_paced || entry.facts.two_states)
        continue; // steps limited by stability, the method's own, or forces that this rod does not have
      const unsigned int  k = error_exponent(entry.facts);
      std::vector<double> steps;
      for (const char *tolerance : {"1e-5", "1e-6", "1e-7", "1e-8", "1e-9"})
        {
          const AdaptiveRod run(neo_hookean(4, std::make_shared<Power>(8e3, 0, 3)), entry.facts.name,
                                {"end=0.02", "step=1e-6", "control/displacement/relative tolerance=0",
                                 std::string("control/displacement/absolute tolerance=") + tolerance});
          steps.push_back(run.counted("accepted steps") + run.counted("rejected steps"));
        }
      const double slope = k * std::log10(steps[4] / steps[2]) / 2;
      EXPECT_GT(slope, 0.7) << entry.facts.name << ": " << ::testing::PrintToString(steps);
      EXPECT_LT(slope, 1.15) << entry.facts.name << ": " << ::testing::PrintToString(steps);
      for (std::size_t i = 1; i < steps.size(); ++i)
        EXPECT_GE(steps[i], steps[i - 1]) << entry.facts.name; // those that grow from the first one may be all
    }
}
