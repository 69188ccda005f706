// SPDX-License-Identifier: LGPL-2.1-or-later
// What every boundary condition of the list promises, found by itself: derivatives, energy, motion, ties, ranks, rigid motions, words.
#include "every_condition.h"
#include "../support/places.h"

#include <myolines/base/error.h>
#include <myolines/fem/rigid_body_modes.h>
#include <myolines/measures/rigid_motions.h>
#include <myolines/muscle3d/body_measures.h>
#include <myolines/muscle3d/loads.h>
#include <myolines/muscle3d/surface_forces.h>
#include <myolines/solve/free_unknowns.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <gtest/gtest.h>

#include <fstream>

namespace myolines
{
  namespace
  {
    TEST_P(EveryCondition, HasTheTangentOfItsForce)
    {
      const ConditionedBody on({it}), off({});
      const Vector          x     = on.random();
      const auto            force = [&](const double du, const double dv) { return less(on.residual(x, du, dv), off.residual(x, du, dv)); };
      for (const bool by_rate : {false, true})
        {
          const double         h          = by_rate ? 1e-3 : 1e-6;
          const WeightsByOrder weights    = by_rate ? WeightsByOrder{{{}, {}, {0, 1, 0}}} : WeightsByOrder{{{}, {}, {1, 0, 0}}};
          Vector               difference = less(force(by_rate ? 0 : h, by_rate ? h : 0), force(by_rate ? 0 : -h, by_rate ? -h : 0));
          difference *= 1 / (2 * h);
          const Vector whole = on.action(weights, x);
          const Vector part  = less(whole, off.action(weights, x));
          EXPECT_LE(less(part, difference).l2_norm(), 1e-6 * difference.l2_norm() + 1e-13 * whole.l2_norm());
          const bool there = facts.pushes && (!by_rate || facts.rates);
          EXPECT_EQ(part.l2_norm() > 1e-6 * whole.l2_norm(), there) << part.l2_norm() << " of " << whole.l2_norm();
        }
      EXPECT_EQ(on.system.capabilities().rates, facts.rates);
    }

    TEST_P(EveryCondition, IsAssembledAsItActs)
    {
      const ConditionedBody on({it});
      const FreeUnknowns    free(on.system.constraints(), on.state.u);
      const WeightsByOrder  weights{{{}, {}, {1, 30, 2e3}}};
      const auto            linearisation = on.system.make_linearisation();
      on.system.linearise({instant, Side::left, on.state.u, on.state.v, on.state.a}, *linearisation);
      Vector x = on.random(), y(x), z(x);
      free.clear_constrained(x);
      Vector all = x;
      free.distribute(all);
      linearisation->apply(weights, all, y);
      free.condense(y);
      linearisation->sparse(weights).vmult(z, x);
      EXPECT_LT(less(y, z).l2_norm(), 1e-12 * y.l2_norm());
    }

    /// Force times velocity is what comes from outside, less what springs take and dashpots lose.
    TEST_P(EveryCondition, WorksAsItsEnergySays)
    {
      const ConditionedBody on({it}), off({});
      const State          &state  = on.state;
      const auto            energy = [&](const double h) {
        State later = state;
        later.u.zero_out_ghost_values();
        later.u.add(h, state.v);
        ConditionedBody::update(later);
        return on.system.surface_forces().work({instant + h, Side::left, later.u, later.v, later.a}).energy;
      };
      const double work = -(less(on.residual(state.u, 0, 0), off.residual(off.state.u, 0, 0)) * state.v);
      const auto   now  = on.system.surface_forces().work({instant, Side::left, state.u, state.v, state.a});
      const double load = on.system.loads().any_external() ? on.system.loads().load_power(instant, Side::left, state.v) : 0;
      const double h = 1e-5, stored = (energy(h) - energy(-h)) / (2 * h);
      EXPECT_NEAR(work, load + now.power - now.dissipation - stored, 1e-7 * (std::abs(work) + std::abs(now.power) + std::abs(stored)));
      EXPECT_EQ(std::abs(work) > 1e-9, facts.loads || facts.pushes) << work;
      EXPECT_EQ(now.energy != 0, facts.supports);
      EXPECT_EQ(now.dissipation > 0, facts.rates);
      const BodyMeasures body = measure_body(on.system, state, SlabRule::quadrature_points);
      EXPECT_EQ(body.stored_springs, now.energy);
      EXPECT_DOUBLE_EQ(body.traction_power, now.power + load);
      EXPECT_DOUBLE_EQ(measure_powers(on.system, state).dissipation, now.dissipation);
    }

    TEST_P(EveryCondition, PrescribesAMotionWithItsRates)
    {
      const ConditionedBody on({it});
      const auto            at = [&](const double t) {
        State state = on.system.still_state();
        on.system.prescribed(t, Side::left, state);
        return state;
      };
      const double h   = 1e-5;
      const State  now = at(instant), before = at(instant - h), after = at(instant + h);
      Vector       v = less(after.u, before.u), a = less(after.v, before.v);
      v *= 1 / (2 * h);
      a *= 1 / (2 * h);
      EXPECT_LE(less(v, now.v).linfty_norm(), 1e-6 * now.v.linfty_norm());
      EXPECT_LE(less(a, now.a).linfty_norm(), 1e-6 * now.a.linfty_norm());
      const bool moves = facts.moving[0] || facts.moving[1] || facts.moving[2];
      EXPECT_EQ(now.u.linfty_norm() > 0, moves);
      EXPECT_EQ(now.v.linfty_norm() > 0, moves);
      const auto &constraints = on.system.constraints();
      const auto &space       = *on.system.discretisation().space;
      for (const auto node : space.face_nodes(face))
        for (unsigned int c = 0; c < 3; ++c)
          if (!facts.ties)
            {
              EXPECT_EQ(constraints.is_constrained(3 * node + c), facts.prescribed[c]);
            }
    }

    TEST_P(EveryCondition, TiesTheFaceAsItSays)
    {
      const ConditionedBody on({it});
      const NodeSpace      &space = *on.system.discretisation().space;
      State                 state = on.state;
      on.system.prescribed(instant, Side::left, state);
      const auto ties = it->ties(space);
      EXPECT_EQ(!ties.empty(), facts.ties);
      EXPECT_EQ(std::count_if(ties.begin(), ties.end(), [](const Tie &tie) { return tie.moves; }), facts.moves_as_one ? 1 : 0);
      for (const Tie &tie : ties)
        {
          double low = 1e9, high = -1e9;
          for (const auto node : space.face_nodes(face))
            {
              const double q = Vector3({state.u(3 * node), state.u(3 * node + 1), state.u(3 * node + 2)}) * tie.direction;
              low            = std::min(low, q);
              high           = std::max(high, q);
            }
          low  = dealii::Utilities::MPI::min(low, MPI_COMM_WORLD);
          high = dealii::Utilities::MPI::max(high, MPI_COMM_WORLD);
          EXPECT_NEAR(low, tie.moves ? high : 0, 1e-16);
          EXPECT_NEAR(high, tie.moves ? low : 0, 1e-16);
        }
    }

    /// The same as on one rank.
    TEST_P(EveryCondition, DoesNotDependOnTheRanks)
    {
      const ConditionedBody shared({it}), alone({it}, MPI_COMM_SELF);
      const auto            numbers = [](const ConditionedBody &body) {
        State state = body.state;
        state.u.zero_out_ghost_values();
        state.u *= 0.1; // ties and motions turn no cell over
        body.system.prescribed(instant, Side::left, state);
        const auto          work = body.system.surface_forces().work({instant, Side::left, state.u, state.v, state.a});
        std::vector<double> all{work.energy, work.power, work.dissipation, state.u.l2_norm(), state.v.l2_norm(), state.a.l2_norm()};
        for (const Reaction &reaction : measure_reactions(body.system, state))
          {
            all.insert(all.end(), {reaction.force[0], reaction.force[1], reaction.force[2], reaction.power});
            all.insert(all.end(), reaction.own.begin(), reaction.own.end());
          }
        Vector r(state.u);
        body.system.residual({instant, Side::left, state.u, state.v, state.a}, r);
        all.push_back(r.l2_norm());
        EXPECT_TRUE(std::isfinite(r.l2_norm()));
        return all;
      };
      const std::vector<double> ours = numbers(shared), expected = numbers(alone);
      ASSERT_EQ(ours.size(), expected.size());
      const double size = expected.back();
      for (std::size_t i = 0; i < ours.size(); ++i)
        EXPECT_NEAR(ours[i], expected[i], 1e-11 * (std::abs(expected[i]) + size)) << i;
    }

    /// What `check` and static starts say of free bodies is what tangent and relations hold.
    TEST_P(EveryCondition, HoldsTheRigidMotionsThatItSays)
    {
      ConditionedBody on({it}), off({});
      for (ConditionedBody *body : {&on, &off})
        {
          body->state   = body->system.still_state();
          body->state.t = 0;
        }
      const NodeSpace    &space = *on.system.discretisation().space;
      const FreeUnknowns  free(on.system.constraints(), on.state.u);
      std::vector<Vector> modes = rigid_body_modes(space, Constraints()), broken, pulled;
      for (Vector &mode : modes)
        {
          mode /= mode.linfty_norm();
          Vector kept = mode;
          free.distribute(kept);
          broken.push_back(less(mode, kept));
          const WeightsByOrder weights{{{}, {}, {1, 0, 0}}};
          Vector               pull = less(on.action(weights, mode), off.action(weights, mode));
          pulled.push_back(pull);
        }
      dealii::LAPACKFullMatrix<double> held(6, 6);
      double                           stiffness = 0;
      for (unsigned int i = 0; i < 6; ++i)
        stiffness = std::max(stiffness, std::abs(modes[i] * pulled[i]));
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          held(i, j) = broken[i] * broken[j] + (facts.supports ? (modes[i] * pulled[j] + modes[j] * pulled[i]) / (2 * stiffness) : 0);
      dealii::Vector<double>     values;
      dealii::FullMatrix<double> vectors;
      held.compute_eigenvalues_symmetric(-1e9, 1e9, 0, values, vectors);
      ASSERT_EQ(values.size(), 6u);
      const double       largest = std::max(1e-3, values.linfty_norm());
      const unsigned int n       = std::count_if(values.begin(), values.end(), [&](const double x) { return x < 1e-10 * largest; });
      const FreeMotions  said    = free_motions(on.system.parameters(), on.system.discretisation());
      EXPECT_EQ(said.translations + said.rotations, n);
    }

    TEST_P(EveryCondition, RefusesAPartOfTheFaceThatIsEmpty)
    {
      const auto &entries = GetParam().schema.entries();
      const bool  parts   = std::any_of(entries.begin(), entries.end(), [](const scene::Entry &entry) { return entry.name == "y from"; });
      if (!parts)
        return;
      EXPECT_FALSE(with({"y from=5"})->facts().part.contains(dealii::Point<3>(0, 0.01, 0)));
      EXPECT_THROW(ConditionedBody({with({"y from=5"})}), InputError); // 5 m away
      EXPECT_THROW(with({"y from=5", "y to=4"}), InputError);
    }

    TEST_P(EveryCondition, HasWordsColumnsAndARowOfThePage)
    {
      EXPECT_EQ(!facts.says_tie.empty(), facts.ties);
      EXPECT_EQ(!facts.says_spring.empty(), facts.supports);
      const ConditionedBody on({it});
      const auto            reactions = measure_reactions(on.system, on.state);
      ASSERT_EQ(reactions.size(), facts.reacts() ? 1u : 0u);
      if (facts.reacts())
        {
          EXPECT_EQ(reactions[0].own.size(), facts.columns.size());
        }
      std::ifstream     page(test::source_folder() + "/doc/boundary_conditions.md");
      const std::string text{std::istreambuf_iterator<char>(page), {}};
      EXPECT_NE(text.find("`" + GetParam().name + "`"), std::string::npos);
    }

    INSTANTIATE_TEST_SUITE_P(Registry, EveryCondition, ::testing::ValuesIn(boundary_registry()), [](const auto &info) {
      std::string name = info.param.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });
  } // namespace
} // namespace myolines
