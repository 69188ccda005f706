// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: bodies that nothing holds, and that move from the beginning.

#include "simulation.h"

#include <myolines/measures/momenta.h>
#include <myolines/measures/rigid_motions.h>
#include <myolines/muscle3d/body_measures.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace myolines
{
  namespace
  {
    using test::condition;
    using test::held;

    Muscle3dParameters passive_block()
    {
      Muscle3dParameters p = test::small_block(2, 4, 0);
      p.geometry.cells     = {{2, 1, 1}};
      p.activation         = nullptr;
      return p;
    }

    test::Condition springs(const double stiffness, const double normal_stiffness)
    {
      return condition("elastic foundation", 0, {test::set("stiffness", stiffness), test::set("normal stiffness", normal_stiffness)});
    }

    /// Free translations and rotations.
    std::pair<unsigned int, unsigned int> free_with(const BoundaryConditions &conditions)
    {
      Muscle3dParameters p = passive_block();
      p.boundary           = conditions;
      const Muscle3dDiscretisation d(p, MPI_COMM_WORLD);
      const FreeMotions            free = free_motions(p, d);
      return {free.translations, free.rotations};
    }

    using Numbers = std::pair<unsigned int, unsigned int>;

    TEST(FreeMotions, AreThoseThatNothingResists)
    {
      EXPECT_EQ(free_with({}), Numbers(3, 3));
      EXPECT_EQ(free_with({held(0)}), Numbers(0, 0));
      EXPECT_EQ(free_with({condition("symmetry plane", 0)}), Numbers(2, 1));
      EXPECT_EQ(free_with({condition("symmetry plane", 0), condition("symmetry plane", 2)}), Numbers(1, 0));
      EXPECT_EQ(free_with({condition("isotonic", 1, {"force=0"})}), Numbers(3, 1)); // the face stays a plane across x
      EXPECT_EQ(free_with({springs(1, 0)}), Numbers(0, 0));
      EXPECT_EQ(free_with({springs(0, 1)}), Numbers(2, 1));
      EXPECT_EQ(free_with({condition("pressure", 1, {"pressure=1"})}), Numbers(3, 3));
      EXPECT_EQ(free_with({held(0, "x")}), Numbers(2, 1));
    }

    constexpr double density = 1060;

    TEST(FreeBodies, FlyStraight)
    {
      Muscle3dParameters p = passive_block();
      p.initial.velocity   = std::array<std::string, 3>{{"0.3", "-0.2", "0.1"}};
      const dealii::Tensor<1, 3> v({0.3, -0.2, 0.1});
      for (const char *method : {"newmark", "sdirk3", "generalized alpha"})
        {
          test::Simulation run(p);
          const Momenta    first  = measure_momenta(run.system, run.state);
          const double     volume = p.geometry.size[0] * p.geometry.size[1] * p.geometry.size[2];
          EXPECT_NEAR(first.mass, density * volume, 1e-12 * first.mass);
          EXPECT_NEAR((first.momentum - first.mass * v).norm(), 0, 1e-14);
          run.go(method, 4, 0.02, [&](const State &state) {
            const Momenta now = measure_momenta(run.system, state);
            EXPECT_NEAR((now.momentum - first.momentum).norm(), 0, 1e-9 * first.momentum.norm()) << method;
            EXPECT_NEAR((now.centre - first.centre - state.t * v).norm(), 0, 1e-9 * p.geometry.size[0]) << method;
          });
        }
    }

    /// Spin about z through the middle, w = 5 1/s.
    Muscle3dParameters spinning_block()
    {
      Muscle3dParameters p           = passive_block();
      const auto         from_middle = [&](const unsigned int c, const char *axis) {
        return "(" + std::string(axis) + " - " + std::to_string(p.geometry.size[c] / 2) + ")";
      };
      p.initial.velocity = std::array<std::string, 3>{{"-5*" + from_middle(1, "y"), "5*" + from_middle(0, "x"), "0"}};
      return p;
    }

    // about their centre, which may fly
    TEST(FreeBodies, SpinWithTheInertiaOfABlock)
    {
      for (const bool flies : {false, true})
        {
          Muscle3dParameters         p = spinning_block();
          const dealii::Tensor<1, 3> v({flies ? 0.3 : 0, flies ? -0.2 : 0, flies ? 0.1 : 0});
          if (flies)
            for (unsigned int c = 0; c < 3; ++c)
              (*p.initial.velocity)[c] += " + " + std::to_string(v[c]);
          test::Simulation run(p);
          const Momenta    m      = measure_momenta(run.system, run.state);
          const double     square = p.geometry.size[0] * p.geometry.size[0] + p.geometry.size[1] * p.geometry.size[1];
          EXPECT_NEAR(m.angular_momentum[2], m.mass * square / 12 * 5, 1e-9 * m.angular_momentum.norm());
          EXPECT_NEAR(std::hypot(m.angular_momentum[0], m.angular_momentum[1]), 0, 1e-9 * m.angular_momentum.norm());
          EXPECT_NEAR((m.momentum - m.mass * v).norm(), 0, 1e-12);
        }
    }

    TEST(FreeBodies, AreSolvedByEveryPreconditionerAlike)
    {
      const Muscle3dParameters p   = spinning_block();
      const auto               end = [&](const char *preconditioner) {
        testing::Solvers solvers({"relative tolerance=1e-10"}, {}, {preconditioner});
        Muscle3dSystem   system(p, MPI_COMM_WORLD, solvers.ledger);
        State            state = system.initial_state(0);
        const auto      &entry = integrator_entry("newmark");
        const auto integrator = entry.make(testing::node(entry.schema), {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
        integrator->start(state);
        for (unsigned int i = 0; i < 3; ++i)
          EXPECT_TRUE(integrator->step(5e-3, state).accepted()) << preconditioner;
        return state.u;
      };
      const Vector direct = end("type=direct");
      Vector       other  = end("type=p multigrid");
      other -= direct;
      EXPECT_LT(other.l2_norm(), 1e-7 * direct.l2_norm());
    }

    /// check(place, displacement, velocity) of every node of this rank at the start of a run with @p p.
    template <typename Check>
    void for_each_initial_node(const Muscle3dParameters &p, const Check &check)
    {
      WorkLedger           ledger;
      const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      const State          state = system.initial_state(0);
      const NodeSpace     &space = *system.discretisation().space;
      for (const auto node : space.nodes().locally_owned_dofs())
        check(space.node_position(node), dealii::Tensor<1, 3>({state.u(3 * node), state.u(3 * node + 1), state.u(3 * node + 2)}),
              dealii::Tensor<1, 3>({state.v(3 * node), state.v(3 * node + 1), state.v(3 * node + 2)}));
    }

    TEST(InitialMotion, IsThatOfTheFormulasWhereNothingIsPrescribed)
    {
      Muscle3dParameters p   = passive_block();
      p.boundary             = {held(0)};
      p.initial.displacement = std::array<std::string, 3>{{"0.1*x", "0.02*z", "1e-4"}};
      for_each_initial_node(p, [](const auto &x, const auto &u, const auto &v) {
        const bool held = x[0] < 1e-12;
        EXPECT_DOUBLE_EQ(u[0], held ? 0 : 0.1 * x[0]);
        EXPECT_DOUBLE_EQ(u[1], held ? 0 : 0.02 * x[2]);
        EXPECT_DOUBLE_EQ(u[2], held ? 0 : 1e-4);
        EXPECT_EQ(v.norm(), 0);
      });
    }

    /// "n" hexahedra per edge of a box around the block, of degree 1, with the linear motion u = (0.1 x, 0.02 z, 1e-4) and v = -u/s.
    std::string mesh_of_motion(const Muscle3dParameters &p, const unsigned int n, const double scale)
    {
      std::ostringstream points, cells, ends, types, u, v;
      points.precision(17);
      u.precision(17);
      v.precision(17);
      const auto place = [n](const unsigned int i, const unsigned int j, const unsigned int k) { return i + (n + 1) * (j + (n + 1) * k); };
      for (unsigned int k = 0; k <= n; ++k)
        for (unsigned int j = 0; j <= n; ++j)
          for (unsigned int i = 0; i <= n; ++i)
            {
              const double x = p.geometry.size[0] * i / n, y = p.geometry.size[1] * j / n, z = p.geometry.size[2] * k / n;
              points << x / scale << " " << y / scale << " " << z / scale << "\n";
              u << 0.1 * x / scale << " " << 0.02 * z / scale << " " << 1e-4 / scale << "\n";
              v << -0.1 * x / scale << " " << -0.02 * z / scale << " " << -1e-4 / scale << "\n";
            }
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
            {
              cells << place(i, j, k) << " " << place(i + 1, j, k) << " " << place(i + 1, j + 1, k) << " " << place(i, j + 1, k) << " "
                    << place(i, j, k + 1) << " " << place(i + 1, j, k + 1) << " " << place(i + 1, j + 1, k + 1) << " "
                    << place(i, j + 1, k + 1) << "\n";
              ends << 8 * (1 + i + n * (j + n * k)) << "\n";
              types << "12\n";
            }
      const std::string array = "<DataArray type=\"Float64\" format=\"ascii\" NumberOfComponents=\"3\" Name=\"";
      const std::string whole = "<DataArray type=\"Int64\" format=\"ascii\" Name=\"";
      return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid><Piece NumberOfPoints=\"" +
             std::to_string((n + 1) * (n + 1) * (n + 1)) + "\" NumberOfCells=\"" + std::to_string(n * n * n) + "\"><Points>" + array +
             "p\">" + points.str() + "</DataArray></Points><Cells>" + whole + "connectivity\">" + cells.str() + "</DataArray>" + whole +
             "offsets\">" + ends.str() + "</DataArray>" + whole + "types\">" + types.str() + "</DataArray></Cells><PointData>" + array +
             "Displacement\">" + u.str() + "</DataArray>" + array + "velocity\">" + v.str() +
             "</DataArray></PointData></Piece></UnstructuredGrid></VTKFile>";
    }

    void expect_the_linear_motion(const Muscle3dParameters &p)
    {
      for_each_initial_node(p, [](const auto &x, const auto &u, const auto &v) {
        const double expected[] = {0.1 * x[0], 0.02 * x[2], 1e-4};
        for (unsigned int c = 0; c < 3; ++c)
          {
            EXPECT_NEAR(u[c], expected[c], 1e-15);
            EXPECT_NEAR(v[c], -expected[c], 1e-15);
          }
      });
    }

    TEST(InitialMotion, IsThatOfAMeshWhereverItsPointsAre)
    {
      for (const double scale : {1., 1e-3})
        for (const unsigned int degree : {2u, 3u})
          {
            Muscle3dParameters          p    = passive_block();
            const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "motion.vtu";
            std::ofstream(file) << mesh_of_motion(p, 3, scale);
            p.boundary     = {};
            p.degree       = degree;
            p.n_points     = 4;
            p.initial.file = std::make_shared<const MotionFile>(file, scale);
            expect_the_linear_motion(p);
          }
    }

    TEST(InitialMotion, IsThatOfATableOfItsNodes)
    {
      Muscle3dParameters p = passive_block();
      p.boundary           = {};
      WorkLedger                  ledger;
      const Muscle3dSystem        system(p, MPI_COMM_WORLD, ledger);
      const NodeSpace            &space = *system.discretisation().space;
      const std::filesystem::path file  = std::filesystem::path(::testing::TempDir()) / "motion.csv";
      const auto                  write = [&](const unsigned int left_out) {
        std::ofstream table(file);
        table.precision(17);
        table << "velocity x [mm/s],velocity y [mm/s],velocity z [mm/s],x [mm],y [mm],z [mm],displacement x [m],displacement y "
                                  "[m],displacement z [m]\n";
        unsigned int row = 0;
        for (const auto node : space.nodes().locally_owned_dofs())
          {
            const dealii::Point<3> &x = space.node_position(node);
            if (row++ != left_out)
              table << -100 * x[0] << "," << -20 * x[2] << "," << -0.1 << "," << 1000 * x[0] << "," << 1000 * x[1] << "," << 1000 * x[2]
                    << "," << 0.1 * x[0] << "," << 0.02 * x[2] << "," << 1e-4 << "\n";
          }
      };
      write(-1);
      p.initial.file = std::make_shared<const MotionFile>(file);
      expect_the_linear_motion(p);
      write(7);
      p.initial.file = std::make_shared<const MotionFile>(file);
      const Muscle3dSystem incomplete(p, MPI_COMM_WORLD, ledger);
      EXPECT_THROW(incomplete.initial_state(0), InputError);
    }
  } // namespace
} // namespace myolines
