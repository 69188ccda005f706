// SPDX-License-Identifier: LGPL-2.1-or-later
// What every boundary condition that pushes promises of a step: the work of its forces, and their derivatives.
#include "every_condition.h"

#include <myolines/muscle3d/loads.h>

namespace myolines
{
  namespace
  {
    class EveryStep : public EveryCondition
    {
    };

    /// A body in a step from three tenths of its displacement, at rest.
    struct SteppingBody : ConditionedBody
    {
      explicit SteppingBody(const BoundaryConditions &conditions)
        : ConditionedBody(conditions)
        , begin(state.u)
      {
        state.v = 0;
        begin *= 0.3;
        update(state);
        begin.update_ghost_values();
      }

      Point point(const Vector &u, const double dissipation) const
      {
        return {instant, Side::left, u, state.v, state.a, nullptr, &begin, dissipation};
      }

      Vector residual(const Vector &x, const double du, const double dissipation) const
      {
        Vector u = state.u, r = state.u;
        u.zero_out_ghost_values();
        u.add(du, x);
        u.update_ghost_values();
        EXPECT_TRUE(system.residual(point(u, dissipation), r).admissible);
        return r;
      }

      Vector begin;
    };

    /// What springs take in a step is the change of their energy, or more; a pressure does the work of the volume that it sweeps, by
    /// Simpson's rule of its forces.
    TEST_P(EveryStep, WorksInAStepAsItsEnergySays)
    {
      if (!facts.pushes)
        return;
      const SteppingBody on({it}), off({});
      Vector             change = less(on.state.u, on.begin);
      const auto         energy = [&](const Vector &u) {
        return on.system.surface_forces().work({instant, Side::left, u, on.state.v, on.state.a}).energy;
      };
      const auto work_at = [&](const double part) {
        Vector u = on.begin, r = u, s = u;
        u.zero_out_ghost_values();
        u.add(part, change);
        u.update_ghost_values();
        on.system.residual({instant, Side::left, u, on.state.v, on.state.a}, r);
        off.system.residual({instant, Side::left, u, on.state.v, on.state.a}, s);
        return less(r, s) * change;
      };
      const double load = on.system.loads().any_external() ? on.system.loads().load_power(instant, Side::left, change) : 0;
      const auto   work = [&](const double dissipation) {
        return less(on.residual(change, 0, dissipation), off.residual(change, 0, dissipation)) * change + load;
      };
      const double expected = facts.supports ? energy(on.state.u) - energy(on.begin) : (work_at(0) + 4 * work_at(0.5) + work_at(1)) / 6;
      EXPECT_NEAR(work(0), expected, 1e-9 * (std::abs(work(0)) + std::abs(load)));
      EXPECT_NE(expected, 0);
      if (facts.supports)
        {
          const double taken = (work_at(1) - work_at(0)) / 2; // by half the change of the force
          EXPECT_GT(taken, 0);
          EXPECT_NEAR(work(0.5) - work(0), taken / 2, 1e-9 * taken + 1e-12 * std::abs(work(0)));
        }
      else
        EXPECT_NEAR(work(0.5), work(0), 1e-12 * std::abs(work(0)));
    }

    TEST_P(EveryStep, HasTheTangentOfItsForceOfAStep)
    {
      const SteppingBody on({it}), off({});
      const Vector       x = on.random();
      for (const double dissipation : {0., 0.5})
        {
          const auto force = [&](const double h) { return less(on.residual(x, h, dissipation), off.residual(x, h, dissipation)); };
          const auto along = [&](const SteppingBody &body) {
            Vector     y(x);
            const auto linearisation = body.system.make_linearisation();
            body.system.linearise(body.point(body.state.u, dissipation), *linearisation);
            linearisation->apply({{{}, {}, {1, 0, 0}}}, x, y);
            return y;
          };
          const double h          = 1e-6;
          Vector       difference = less(force(h), force(-h));
          difference *= 1 / (2 * h);
          const Vector whole = along(on), part = less(whole, along(off));
          EXPECT_LE(less(part, difference).l2_norm(), 1e-6 * difference.l2_norm() + 1e-13 * whole.l2_norm());
        }
    }

    INSTANTIATE_TEST_SUITE_P(Registry, EveryStep, ::testing::ValuesIn(boundary_registry()), [](const auto &info) {
      std::string name = info.param.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });
  } // namespace
} // namespace myolines
