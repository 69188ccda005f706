// SPDX-License-Identifier: LGPL-2.1-or-later
// Manufactured solution in space through the whole program path: formulas in, static solve, L2 error out.
#include "../support/solvers.h"
#include "fixtures.h"

#include <myolines/time/integrator.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    // u = (A sin(2 pi x/L), 0, B sin(pi x/L)): F has s = 1 + u_x' and g = u_z', everything else is the identity, and with
    // constant psi1 = S c1 the stress columns are, by hand,
    //   P_xx = kappa/2 (s - 1/s) + S c1 (4/3 s^(1/3) - 2/3 (g^2 + 2) s^(-5/3)),   P_zx = 2 S c1 s^(-2/3) g,
    // so that the body force is f = -(dP_xx/dx, 0, dP_zx/dx).
    const std::string s   = "(1+0.001*2*pi/0.03*cos(2*pi*x/0.03))";
    const std::string ds  = "(-0.001*(2*pi/0.03)^2*sin(2*pi*x/0.03))";
    const std::string g   = "(0.002*pi/0.03*cos(pi*x/0.03))";
    const std::string dg  = "(-0.002*(pi/0.03)^2*sin(pi*x/0.03))";
    const std::string u_x = "0.001*sin(2*pi*x/0.03)", u_z = "0.002*sin(pi*x/0.03)";
    constexpr double  kappa = 1e6, S_c1 = 5e4;

    Muscle3dParameters problem(const unsigned int degree, const unsigned int refinement)
    {
      Muscle3dParameters p;
      p.dynamic               = false;
      p.degree                = degree;
      p.n_points              = degree + 2;
      p.geometry.size         = {{0.03, 0.01, 0.01}};
      p.geometry.cells        = {{3, 1, 1}};
      p.geometry.refinement   = refinement;
      p.muscle().bulk_modulus = kappa;
      p.muscle().fibre.sigma0 = 0;
      p.muscle().base.scale   = 1;
      p.muscle().base.c[0]    = S_c1;
      p.muscle().base.c[1]    = 0;
      const std::string K = "1e6", C = "5e4";
      p.body_force =
          std::array<std::string, 3>{{"-((" + K + "/2*(1+1/" + s + "^2)+" + C + "*(4/9*" + s + "^(-2/3)+10/9*(" + g + "^2+2)*" + s +
                                          "^(-8/3)))*" + ds + "-" + C + "*4/3*" + g + "*" + s + "^(-5/3)*" + dg + ")",
                                      "0", "-(2*" + C + "*(" + s + "^(-2/3)*" + dg + "-2/3*" + s + "^(-5/3)*" + g + "*" + ds + "))"}};
      for (unsigned int face = 0; face < 6; ++face)
        p.boundary.push_back(test::condition("formula", face, {"displacement x=" + u_x, "displacement z=" + u_z}));
      return p;
    }

    /// Quadrilateral-faced cells: inner vertices move, the box stays a box.
    dealii::Point<3> shake(const dealii::Point<3> &x)
    {
      const double bubble = std::sin(dealii::numbers::PI * x[0] / 0.03) * std::sin(dealii::numbers::PI * x[1] / 0.01) *
                            std::sin(dealii::numbers::PI * x[2] / 0.01);
      return {x[0] + 0.001 * bubble, x[1] - 0.0007 * bubble, x[2] + 0.0006 * bubble};
    }

    double l2_error(const unsigned int degree, const unsigned int refinement)
    {
      testing::Solvers solvers({"relative tolerance=1e-11"}, {}, {"type=direct"});
      Muscle3dSystem   system(problem(degree, refinement), MPI_COMM_WORLD, solvers.ledger);
      system.move_mesh(shake);
      const IntegratorEntry &entry = integrator_entry("static");
      const auto integrator = entry.make(testing::node(entry.schema), {system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
      State      state      = system.initial_state(0);
      state.u               = 0; // the prescribed motion is lifted by the solver
      integrator->start(state);
      const StepReport report = integrator->step(1., state);
      EXPECT_TRUE(report.accepted()) << report.reason;

      const NodeSpace                             &space = *system.discretisation().space;
      dealii::FEValues<3>                          values(space.nodes().get_fe(), dealii::QGauss<3>(degree + 3),
                                                          dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values);
      std::vector<dealii::types::global_dof_index> nodes(values.dofs_per_cell);
      double                                       square = 0;
      for (const auto &cell : space.nodes().active_cell_iterators())
        {
          values.reinit(cell);
          cell->get_dof_indices(nodes);
          for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
            {
              const double         x = values.quadrature_point(q)[0];
              dealii::Tensor<1, 3> error(
                  {-0.001 * std::sin(2 * dealii::numbers::PI * x / 0.03), 0, -0.002 * std::sin(dealii::numbers::PI * x / 0.03)});
              for (unsigned int i = 0; i < nodes.size(); ++i)
                for (unsigned int c = 0; c < 3; ++c)
                  error[c] += values.shape_value(i, q) * state.u(3 * nodes[i] + c);
              square += error.norm_square() * values.JxW(q);
            }
        }
      return std::sqrt(square);
    }

    class Manufactured : public ::testing::TestWithParam<unsigned int>
    {
    };

    TEST_P(Manufactured, OrderInSpaceIsDegreePlusOne)
    {
      const unsigned int degree = GetParam(), finest = degree == 1 ? 3 : 2;
      const double       coarse = l2_error(degree, finest - 1), fine = l2_error(degree, finest);
      const double       order = std::log2(coarse / fine);
      RecordProperty("order", std::to_string(order));
      EXPECT_GT(order, degree + 1 - 0.25) << coarse << " " << fine;
      EXPECT_LT(order, degree + 1 + 0.8) << coarse << " " << fine;
    }

    INSTANTIATE_TEST_SUITE_P(Degrees, Manufactured, ::testing::Values(1u, 2u, 3u));
  } // namespace
} // namespace myolines
