// SPDX-License-Identifier: LGPL-2.1-or-later
// The massless unit, whose force depends on its velocity, by fixed steps: every method that takes it has its order there, up to the second,
// which the printed curves, smooth in pieces only, allow.

#include "run.h"

using namespace myolines;
using namespace myolines::testing;

namespace
{
  struct End
  {
    double u, v;
  };

  End end_of(const IntegratorEntry &entry, const unsigned int n)
  {
    Solvers              solvers({"relative tolerance=1e-13", "absolute tolerance=3e-12"});
    const Muscle1dSystem system(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), unit_settings("mild", "1", "0"))),
                                solvers.ledger);
    const auto method = entry.make(node(entry.schema), IntegratorContext{system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
    State      state  = system.initial_state(0);
    method->start(state);
    for (unsigned int i = 0; i < n; ++i)
      {
        const StepReport report = method->step(0.3 / n, state);
        EXPECT_TRUE(report.accepted()) << entry.facts.name << ": " << report.reason;
      }
    return {state.u.local_element(0), state.v.local_element(0)};
  }
} // namespace

TEST(MasslessUnit, IsIntegratedWithTheOrderOfTheMethodUpToTheSecond)
{
  const End    reference = end_of(integrator_entry("sdirk3"), 1000);
  unsigned int methods   = 0;
  for (const IntegratorEntry &entry : integrator_registry())
    {
      if (!entry.make || !entry.facts.dynamic || entry.facts.unknowns == MethodFacts::Unknowns::second_order ||
          entry.facts.name == "newmark")
        continue;
      ++methods;
      const unsigned int n      = entry.facts.order == 3 ? 40 : 160;
      const End          coarse = end_of(entry, n), fine = end_of(entry, 2 * n);
      for (const double order :
           {std::log2((coarse.u - reference.u) / (fine.u - reference.u)), std::log2((coarse.v - reference.v) / (fine.v - reference.v))})
        EXPECT_GT(order, std::min(entry.facts.order, 2u) - 0.15) << entry.facts.name;
    }
  EXPECT_GE(methods, 8u);
}
