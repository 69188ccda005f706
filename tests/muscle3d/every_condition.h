// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fixtures.h"

#include <myolines/muscle3d/surface_forces.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    constexpr double       instant = 0.07; // of examples: no drive has a kink there, none is zero
    constexpr unsigned int face    = 3;

    /// Turned and sheared: no axis is that of a face, planes stay planes.
    dealii::Point<3> turn_and_shear(const dealii::Point<3> &x)
    {
      const Vector3 axis({1. / 3, 2. / 3, 2. / 3}), X({x[0] + 0.2 * x[1], x[1], x[2] + 0.1 * x[0]});
      return dealii::Point<3>(std::cos(0.7) * X + std::sin(0.7) * cross_product_3d(axis, X) + (1 - std::cos(0.7)) * (axis * X) * axis);
    }

    /// A passive block, turned, in smooth motion, with a condition or without.
    struct ConditionedBody
    {
      explicit ConditionedBody(const BoundaryConditions &conditions, const MPI_Comm communicator = MPI_COMM_WORLD)
        : system(parameters(conditions), communicator, ledger)
      {
        system.move_mesh(turn_and_shear);
        state                  = system.still_state();
        state.t                = instant;
        const NodeSpace &space = *system.discretisation().space;
        for (const auto node : space.nodes().locally_owned_dofs())
          for (unsigned int c = 0; c < 3; ++c)
            {
              const dealii::Point<3> &x = space.node_position(node);
              state.u(3 * node + c)     = 0.05 * x[(c + 1) % 3] + 4 * x[c] * x[(c + 2) % 3];
              state.v(3 * node + c)     = 0.3 * x[(c + 2) % 3] - 20 * x[c] * x[(c + 1) % 3] + 0.01;
            }
        update(state);
      }

      static Muscle3dParameters parameters(const BoundaryConditions &conditions)
      {
        Muscle3dParameters p = test::small_block(2, 3, 1);
        p.activation         = nullptr;
        p.boundary           = conditions;
        return p;
      }

      static void update(State &state)
      {
        for (Vector *x : {&state.u, &state.v, &state.a})
          x->update_ghost_values();
      }

      /// At this instant, displaced by @p du x and faster by @p dv x.
      Vector residual(const Vector &x, const double du, const double dv) const
      {
        State  moved = state;
        Vector r(state.u);
        for (Vector *y : {&moved.u, &moved.v})
          y->zero_out_ghost_values();
        moved.u.add(du, x);
        moved.v.add(dv, x);
        update(moved);
        EXPECT_TRUE(system.residual({state.t, Side::left, moved.u, moved.v, moved.a}, r).admissible);
        return r;
      }

      Vector action(const WeightsByOrder &weights, const Vector &x) const
      {
        Vector     y(x);
        const auto linearisation = system.make_linearisation();
        system.linearise({state.t, Side::left, state.u, state.v, state.a}, *linearisation);
        linearisation->apply(weights, x, y);
        return y;
      }

      Vector random() const
      {
        Vector x = system.discretisation().space->make_vector();
        for (const auto i : x.locally_owned_elements())
          x(i) = std::sin(3 + 7.13 * i * (1 + i % 5));
        return x;
      }

      WorkLedger     ledger;
      Muscle3dSystem system;
      State          state;
    };

    /// Owned entries of the first vector less those of the second; numberings may differ by ghosts.
    Vector less(Vector left, const Vector &right)
    {
      for (unsigned int i = 0; i < left.locally_owned_size(); ++i)
        left.local_element(i) -= right.local_element(i);
      return left;
    }

    class EveryCondition : public ::testing::TestWithParam<BoundaryEntry>
    {
    protected:
      test::Condition with(std::vector<std::string> more = {}) const
      {
        more.insert(more.begin(), GetParam().example.begin(), GetParam().example.end());
        return test::condition(GetParam().name, face, more, "it");
      }
      const test::Condition it    = with();
      const BoundaryFacts  &facts = it->facts();
    };
  } // namespace
} // namespace myolines
