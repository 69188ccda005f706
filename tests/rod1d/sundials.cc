// SPDX-License-Identifier: LGPL-2.1-or-later
// SUNDIALS at tight tolerances against the exact-in-time solution of the same elements of the Neo-Hookean rod.

#include "../support/table.h"
#include "rod.h"

#include <myolines/rod1d/rod1d_system.h>
#include <myolines/system/drive_types.h>
#include <myolines/time/error_control.h>
#include <myolines/time/loop.h>
#include <myolines/time/start.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  /// Largest error of u [m] at all nodes and times up to @p last [s] of nh_semidiscrete_reference.csv.
  double error(const std::string &start, const unsigned int n_elements, const double last, const std::string &method,
               const Overrides &parameters)
  {
    Solvers           solvers;
    const Rod1dSystem system(thesis_rod(3, n_elements), solvers.ledger);
    const scene::Node time   = node(time_schema(), {"end=1", "step=1e-7", "control/type=error", "control/displacement/relative tolerance=0",
                                                    "control/displacement/absolute tolerance=1e-13", "control/velocity/relative tolerance=0",
                                                    "control/velocity/absolute tolerance=1e-9", "control/solver fraction=0.001"});
    const auto        norm   = make_error_norm(time, system);
    const auto        jump   = start == "impulse" ? StartVelocity::impulse : StartVelocity::consistent;
    const auto       &entry  = integrator_entry(method);
    const auto        runner = entry.make_self_paced(node(entry.schema, parameters),
                                                     {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger, jump, norm.get()},
                                                     error_control_limits(time));
    State             state  = starting_state(system, 0, BoundaryRates::exact, jump);
    double            largest = 0;
    unsigned int      n       = 0;
    runner->start(state);
    for (const Row &row : rows("nh_semidiscrete_reference.csv"))
      {
        const double t = std::stod(row[2]);
        if (row[0] != start || std::stoul(row[1]) != n_elements || t > last)
          continue;
        while (state.t < t)
          {
            const StepReport report = runner->advance(t, state);
            if (!report.accepted())
              throw std::runtime_error(report.reason);
          }
        largest = std::max(largest, std::abs(state.u(std::stoul(row[3])) - std::stod(row[5])));
        ++n;
      }
    EXPECT_GE(n, 2 * n_elements + 1);
    return largest;
  }
} // namespace

TEST(SundialsRod, reachesTheSolutionOfTheSemiDiscreteSystem)
{
  const std::vector<std::pair<std::string, Overrides>> methods = {
      {"ida", {}},
      {"cvode", {}},
      {"cvode", {"formula=adams", "maximum order=12", "iteration=fixed point"}},
      {"arkode", {"implicit table=ESDIRK547L2SA_7_4_5"}},
      {"arkode", {"implicit table=none", "explicit table=DORMAND_PRINCE_7_4_5"}}};
  for (const char *start : {"impulse", "noimpulse"})
    for (const auto &[name, parameters] : methods)
      EXPECT_LT(error(start, 8, 0.0101, name, parameters), 1e-9) << name << ::testing::PrintToString(parameters) << ", " << start;
}
