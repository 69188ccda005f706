// SPDX-License-Identifier: LGPL-2.1-or-later
// An active muscle that comes to rest beside its tendon stays there, with every implicit method, any step and nothing but defaults.
#include "run.h"

#include <myolines/muscle1d/muscle_tendon_unit.h>

#include <cmath>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  /// Semitendinosus at a fixed length, activated within 0.2 s, as input/one_dimensional/continuum_hold.xml.
  Muscle1dParameters holding(const std::string &elements)
  {
    return read_continuum_muscle(node(
        continuum_muscle_schema(), {"elements=" + elements, "input/type=profiles", "input/length/type=constant", "input/length/value=0.41",
                                    "input/excitation/type=ramp", "input/excitation/amplitude=1", "input/excitation/duration=0.2"}));
  }

  class AtRest : public ::testing::TestWithParam<std::string>
  {
  protected:
    /// Until 3 s with steps that must not fail.
    State held(const Muscle1dSystem &system, Solvers &solvers, const double dt)
    {
      const IntegratorEntry  &entry = integrator_entry(GetParam());
      const scene::Node       time  = node(time_schema(), {"end=3", "step=" + text(dt), "control/type=fixed"});
      const IntegratorContext context{system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger};
      State                   state = system.initial_state(0);
      run_loop(system, *make_integrator(entry, node(entry.schema), context), *make_step_control(time, 0), loop_settings(time), state, {},
               solvers.ledger);
      return state;
    }
  };
} // namespace

// At the end muscle and tendon pull alike at the stretch that solves an equation for one number.
TEST_P(AtRest, aContinuumMuscleHoldsItsTendon)
{
  for (const std::string elements : {"16", "60"})
    for (const double dt : {1e-3, 1e-2, 5e-2})
      {
        Solvers              solvers;
        const Muscle1dSystem system(holding(elements), solvers.ledger);
        State                end;
        ASSERT_NO_THROW(end = held(system, solvers, dt)) << elements << ", " << dt;
        EXPECT_EQ(solvers.ledger.counted("rejected steps"), 0u);

        const Muscle1dParameters &p    = system.parameters();
        const double              a    = system.activation(3, end.u);
        const auto                pull = [&](const double stretch) {
          return hill::tendon((0.41 - stretch * p.optimal_length) / p.tendon->optimal_length).value - p.force.isometric(stretch, a).value;
        };
        double low = 0.5, high = 1; // the muscle is stronger at high
        for (unsigned int i = 0; i < 60; ++i)
          (pull((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
        EXPECT_NEAR(a, 1, 1e-6);
        EXPECT_NEAR(system.muscle_stretch(end.u), low, 1e-6) << elements << ", " << dt;
        for (const double stretch : system.element_stretches(end.u)) // force-velocity evens them out within seconds
          EXPECT_NEAR(stretch, low, 2e-3) << elements << ", " << dt;
        EXPECT_LT(end.v.linfty_norm(), 1e-4);
      }
}

INSTANTIATE_TEST_SUITE_P(Methods, AtRest,
                         ::testing::Values("backward euler", "bdf2", "tr-bdf2", "sdirk2", "sdirk3", "newmark", "hht alpha", "wbz alpha",
                                           "generalized alpha", "wilson theta"),
                         [](const auto &info) {
                           std::string name = info.param;
                           for (char &c : name)
                             c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

// What the residual balances is the force in the elements, and displacements of a whole muscle are known to rounding only.
TEST(Muscle1d, tellsTheSizeOfItsForces)
{
  WorkLedger           ledger;
  const Muscle1dSystem system(holding("16"), ledger);
  State                state = system.initial_state(0);
  Vector               r(state.u);
  const double         F_0    = system.parameters().maximum_force;
  const Evaluation     slack  = system.residual({0, Side::left, state.u, state.v, state.a}, r);
  const Evaluation     active = system.residual({1, Side::left, state.u, state.v, state.a}, r);
  const double         a      = system.activation(1, state.u);
  const double         force  = F_0 * system.parameters().force.isometric(system.muscle_stretch(state.u), a).value;
  const double         tendon = hill::tendon((0.41 - system.muscle_stretch(state.u) * system.parameters().optimal_length) /
                                             system.parameters().tendon->optimal_length)
                            .value *
                        F_0;
  EXPECT_NEAR(active.forces, std::sqrt(16.) * force + tendon, 1e-9 * F_0);
  EXPECT_LT(slack.forces, 0.1 * active.forces);
  EXPECT_GT(active.rounding, 1e-16 * F_0);
  EXPECT_LT(active.rounding, 1e-12 * F_0);

  // rounding: no nearby number of the displacements has a residual that differs by much more
  const Vector before = r;
  for (unsigned int i = 0; i < state.u.size(); ++i)
    state.u(i) = std::nextafter(state.u(i) + 1e-3, i % 2 == 0 ? 1. : 0.) - 1e-3;
  const Evaluation moved = system.residual({1, Side::left, state.u, state.v, state.a}, r);
  r -= before;
  EXPECT_LT(r.l2_norm(), 10 * moved.rounding);
}
