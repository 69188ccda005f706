// SPDX-License-Identifier: LGPL-2.1-or-later
// Forces on faces and relations between unknowns: tangents beside differences, both operators, and the preconditioners.
#include "../support/solvers.h"
#include "fixtures.h"

#include <myolines/base/error.h>
#include <myolines/solve/free_unknowns.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    using test::condition;

    BoundaryConditions everything()
    {
      return {condition("follower pressure", 3, {"pressure=2e5", "x from=0.005"}),
              condition("elastic foundation", 4, {"stiffness=3e7", "normal stiffness=1e8"}),
              condition("tendon spring", 1,
                        {"direction=0.8 0 0.6", "spring/type=tendinous", "spring/force=20", "spring/slack length=0.05",
                         "motion/type=constant", "motion/value=0.004"}),
              // its stop is touched by a part of the points of this state
              condition("isotonic", 0, {"direction=0.6 0.8 0", "force=3", "across=held", "stop/stiffness=1e6", "stop/position=2e-4"})};
    }

    /// A muscle at a smooth state, its mesh turned or distorted by a map.
    struct Problem
    {
      using Map = dealii::Point<3> (*)(const dealii::Point<3> &);

      Problem(Muscle3dParameters parameters, const Map map, const double amplitude = 1)
        : system(std::move(parameters), MPI_COMM_WORLD, ledger)
        , linearisation(system.make_linearisation())
      {
        system.move_mesh(map);
        state             = system.initial_state(0);
        const auto &space = *system.discretisation().space;
        for (const auto node : space.nodes().locally_owned_dofs())
          {
            const auto &x = space.node_position(node);
            for (unsigned int c = 0; c < 3; ++c)
              state.u(3 * node + c) = amplitude * (0.05 * x[(c + 1) % 3] + 4 * x[c] * x[(c + 2) % 3]);
          }
        for (Vector *x : {&state.u, &state.v, &state.a})
          x->update_ghost_values();
        linearisation = system.make_linearisation();
        system.linearise({0, Side::left, state.u, state.v, state.a}, *linearisation);
      }

      Vector residual(const double h, const Vector &x) const
      {
        Vector u(state.u), r(state.u);
        u.zero_out_ghost_values();
        u.add(h, x);
        u.update_ghost_values();
        EXPECT_TRUE(system.residual({0, Side::left, u, state.v, state.a}, r).admissible);
        return r;
      }

      Vector random(const unsigned int seed) const
      {
        Vector x = system.discretisation().space->make_vector();
        for (const auto i : x.locally_owned_elements())
          x(i) = std::sin(seed + 7.13 * i * (1 + i % 5));
        return x;
      }

      WorkLedger                     ledger;
      Muscle3dSystem                 system;
      std::unique_ptr<Linearisation> linearisation;
      State                          state;
    };

    Muscle3dParameters parameters(const unsigned int degree, const BoundaryConditions &boundary, const unsigned int refinement = 1)
    {
      Muscle3dParameters p = test::small_block(degree, degree + 1, refinement);
      p.dynamic            = false;
      p.boundary           = boundary;
      return p;
    }

    class BoundaryTerms : public ::testing::TestWithParam<unsigned int>
    {
    };

    TEST_P(BoundaryTerms, TangentIsTheDerivative)
    {
      const Problem problem(parameters(GetParam(), everything()), test::distort);
      const Vector  x = problem.random(3);
      Vector        y(x), difference = problem.residual(1e-8, x);
      problem.linearisation->apply(stage_weights(1, 0, 0), x, y);
      difference -= problem.residual(-1e-8, x);
      difference *= 8;
      difference += problem.residual(-2e-8, x);
      difference -= problem.residual(2e-8, x);
      difference *= 1 / 12e-8;
      y -= difference;
      EXPECT_LT(y.l2_norm(), 1e-7 * difference.l2_norm());
      EXPECT_FALSE(problem.system.capabilities().symmetric_tangent);
    }

    /// The part of the faces alone, seen in the difference to a body without them: it must not hide behind the bulk modulus.
    TEST_P(BoundaryTerms, TangentOfTheFacesAloneIsTheDerivative)
    {
      Problem      with(parameters(GetParam(), everything()), test::distort), without(parameters(GetParam(), {}), test::distort);
      const Vector x    = with.random(3);
      const auto   face = [&](const double h) {
        Vector r = with.residual(h, x);
        Vector s = without.residual(h, x);
        // numbering may differ by shared nodes only in the ghosts
        for (unsigned int i = 0; i < r.locally_owned_size(); ++i)
          r.local_element(i) -= s.local_element(i);
        return r;
      };
      Vector y(x), z(without.state.u), difference = face(1e-6);
      with.linearisation->apply(stage_weights(1, 0, 0), x, y);
      without.linearisation->apply(stage_weights(1, 0, 0), x, z);
      difference -= face(-1e-6);
      difference *= 0.5e6;
      const double size = y.l2_norm();
      for (unsigned int i = 0; i < y.locally_owned_size(); ++i)
        y.local_element(i) -= z.local_element(i) + difference.local_element(i);
      EXPECT_GT(difference.l2_norm(), 1e-6 * size);
      EXPECT_LT(y.l2_norm(), 1e-6 * difference.l2_norm() + 1e-13 * size);
    }

    TEST_P(BoundaryTerms, AssembledMatrixEqualsTheCondensedAction)
    {
      for (const bool exact : {true, false})
        {
          Muscle3dParameters p = parameters(GetParam(), everything());
          p.exact_tangent      = exact;
          const Problem      problem(p, test::distort);
          const FreeUnknowns free(problem.system.constraints(), problem.state.u);
          EXPECT_TRUE(free.related());
          Vector x = problem.random(5), y(x), z(x), all(x);
          free.clear_constrained(x);
          all = x;
          free.distribute(all);
          problem.linearisation->apply(stage_weights(1, 0, 0), all, y);
          free.condense(y);
          problem.linearisation->sparse(stage_weights(1, 0, 0)).vmult(z, x);
          const double size = y.l2_norm();
          y -= z;
          EXPECT_LT(y.l2_norm(), 1e-12 * size);
        }
    }

    INSTANTIATE_TEST_SUITE_P(Degrees, BoundaryTerms, ::testing::Values(1u, 2u, 3u));

    /// Relations hold for what the system prescribes, and what it gives them satisfies the constraints that solvers know.
    TEST(Relations, OfSystemAndSolversAreTheSame)
    {
      const Problem      problem(parameters(2, everything()), test::distort);
      const FreeUnknowns free(problem.system.constraints(), problem.state.u);
      State              state = problem.state;
      problem.system.prescribed(0, Side::left, state);
      Vector x = state.u;
      free.distribute(x);
      x -= state.u;
      EXPECT_LT(x.linfty_norm(), 1e-16);
      const auto          &space = *problem.system.discretisation().space;
      double               low = 1, high = -1;
      dealii::Tensor<1, 3> n({0.8, 0, 0.6});
      const auto           range = [&](const unsigned int face, const dealii::Tensor<1, 3> &along) {
        low = 1, high = -1;
        for (const auto node : space.face_nodes(face))
          {
            const double q = state.u(3 * node) * along[0] + state.u(3 * node + 1) * along[1] + state.u(3 * node + 2) * along[2];
            low            = std::min(low, q);
            high           = std::max(high, q);
          }
        low  = dealii::Utilities::MPI::min(low, MPI_COMM_WORLD);
        high = dealii::Utilities::MPI::max(high, MPI_COMM_WORLD);
      };
      range(1, n);
      EXPECT_GT(std::abs(high), 1e-5);
      EXPECT_LT(high - low, 1e-16);
      range(0, dealii::Tensor<1, 3>({0, 0, 1}));
      EXPECT_EQ(high, 0.);
      EXPECT_EQ(low, 0.);
    }

    dealii::Point<3> turn(const dealii::Point<3> &x)
    {
      // about (1, 2, 2)/3 by 0.7
      const dealii::Tensor<1, 3> axis({1. / 3, 2. / 3, 2. / 3}), X(x);
      return dealii::Point<3>(std::cos(0.7) * X + std::sin(0.7) * cross_product_3d(axis, X) + (1 - std::cos(0.7)) * (axis * X) * axis);
    }

    TEST(PMultigridWithRelations, SolvesLikeTheFactorisationInFewIterations)
    {
      const auto straight = condition("isotonic", 1, {"force=0"}), held = condition("isotonic", 1, {"force=0", "across=held"}),
                 oblique = condition("isotonic", 1, {"force=0", "direction=0.9 0.3 0.31622776601683794"}), end = test::held(0);
      const BoundaryConditions mirrored{condition("symmetry plane", 0), condition("symmetry plane", 2), condition("symmetry plane", 4)};
      const std::vector<BoundaryConditions> cases{
          mirrored, {end, straight}, {end, held}, {end, oblique}, {mirrored[0], mirrored[1], mirrored[2], oblique}};
      for (std::size_t i = 0; i < cases.size(); ++i)
        for (const unsigned int degree : {2u, 3u})
          for (const auto map : {turn, test::distort})
            {
              if (map == test::distort && cases[i].size() > 2)
                continue;
              Muscle3dParameters p = parameters(degree, cases[i], degree == 2 ? 2 : 1);
              p.n_points           = 4;
              p.activation         = nullptr;
              Problem problem(p, map, 1e-3);
              Vector  b = problem.random(2), x(b), expected(b);
              for (const std::string type : {"p multigrid", "direct"})
                {
                  testing::Solvers   solvers({}, {}, {"type=" + type});
                  const LinearReport report =
                      solvers.linear.solve(*problem.linearisation, stage_weights(1, 0, 0), problem.system.constraints(), true, b,
                                           type == "direct" ? expected : x, type == "direct" ? 1e-10 : 1e-6);
                  EXPECT_TRUE(report.converged) << type << ", case " << i << ": " << report.reason;
                  EXPECT_LE(report.iterations, 70u) << type << ", case " << i;
                }
              expected -= x;
              EXPECT_LT(expected.l2_norm(), 1e-3 * x.l2_norm());
            }
    }

    TEST(Relations, ContradictionsAreRefused)
    {
      const auto pull = condition("isotonic", 1, {"force=0"}); // meets face 2
      WorkLedger ledger;
      EXPECT_THROW(Muscle3dSystem(parameters(2, {test::held(2), pull}), MPI_COMM_WORLD, ledger), InputError);
      EXPECT_NO_THROW(Muscle3dSystem(parameters(2, {test::held(2, "y z"), pull}), MPI_COMM_WORLD, ledger));

      const auto moved = [](const std::string &direction) {
        return condition("strain", 2, {"direction=" + direction, "reference length=1", "strain/type=constant", "strain/value=0"},
                         "lengthening");
      };
      const auto mirror = [](const unsigned int face) { return condition("symmetry plane", face, {}, "mirror"); };
      try
        {
          Muscle3dSystem(parameters(2, {moved("1 0 0"), mirror(1)}), MPI_COMM_WORLD, ledger);
          ADD_FAILURE() << "moves across a mirror";
        }
      catch (const InputError &error)
        {
          EXPECT_NE(std::string(error.what()).find("\"lengthening\" and \"mirror\""), std::string::npos) << error.what();
        }
      // the vertex of face 4 where all coordinates are smallest is node 0
      EXPECT_NO_THROW(Muscle3dSystem(parameters(2, {moved("1 0 0"), mirror(4)}), MPI_COMM_WORLD, ledger));
      EXPECT_THROW(Muscle3dSystem(parameters(2, {moved("0 0 1"), mirror(4)}), MPI_COMM_WORLD, ledger), InputError);

      Muscle3dSystem bent(parameters(2, {}), MPI_COMM_WORLD, ledger);
      const auto     sine = [](const dealii::Point<3> &x) { return dealii::Point<3>(x[0], x[1] + 0.01 * std::sin(50 * x[0]), x[2]); };
      EXPECT_NO_THROW(bent.move_mesh(sine));
      Muscle3dSystem mirrored(parameters(2, {condition("symmetry plane", 2)}), MPI_COMM_WORLD, ledger);
      EXPECT_THROW(mirrored.move_mesh(sine), InputError);
    }
  } // namespace
} // namespace myolines
