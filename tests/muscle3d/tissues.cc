// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies of several tissues, and fields over the body.
#include "../support/temporary.h"
#include "fixtures.h"

#include <myolines/base/error.h>
#include <myolines/muscle3d/body_measures.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace myolines
{
  namespace
  {
    /// The idealised gastrocnemius at refinement 1, fully active.
    Muscle3dParameters gastrocnemius()
    {
      Muscle3dParameters p;
      p.n_points                                = 3;
      p.geometry.gastrocnemius                  = Gastrocnemius();
      p.geometry.size                           = {{0.27, 0.055, 0.023}};
      p.geometry.cells                          = {{4, 4, 2}};
      p.geometry.refinement                     = 0;
      p.tissues[aponeurosis_id]                 = tissue_kinds()[aponeurosis_id - 1].defaults;
      p.muscle().fibre.direction                = p.geometry.gastrocnemius->fibre_direction();
      p.tissues[aponeurosis_id].fibre.direction = p.geometry.gastrocnemius->aponeurosis_direction();
      p.activation                              = std::make_shared<test::ConstantDrive>(0.7);
      return p;
    }

    /// A smooth state: stretched, sheared, shortening.
    State deformed(const Muscle3dSystem &system)
    {
      State       state = system.initial_state(0);
      const auto &space = *system.discretisation().space;
      const auto &size  = system.parameters().geometry.size;
      for (const auto node : space.nodes().locally_owned_dofs())
        {
          const dealii::Point<3> &x = space.node_position(node);
          for (unsigned int c = 0; c < 3; ++c)
            {
              state.u(3 * node + c) = 0.05 * x[c] * (1.3 - x[(c + 1) % 3] / size[(c + 1) % 3]) + 0.03 * x[(c + 2) % 3];
              state.v(3 * node + c) = -0.4 * x[c];
            }
        }
      return state;
    }

    Vector residual(const Muscle3dSystem &system, const State &state)
    {
      Vector           r(state.u);
      const Evaluation evaluation = system.residual({0, Side::left, state.u, state.v, state.a}, r);
      EXPECT_TRUE(evaluation.admissible) << evaluation.reason;
      return r;
    }

    double relative_difference(Vector a, const Vector &b)
    {
      a -= b;
      return a.l2_norm() / b.l2_norm();
    }

    TEST(Gastrocnemius, HasItsVolumeAndItsFaces)
    {
      WorkLedger           ledger;
      const Muscle3dSystem system(gastrocnemius(), MPI_COMM_WORLD, ledger);
      const Gastrocnemius  g;
      const double         layers = 2 * g.aponeurosis_length * std::cos(g.aponeurosis_angle()) * g.aponeurosis_height * g.width;
      const double         muscle =
          g.fibre_length() * g.aponeurosis_length * std::sin(g.aponeurosis_angle() + g.pennation * dealii::numbers::PI / 180) * g.width;
      const BodyMeasures m = measure_body(system, system.initial_state(0), SlabRule::quadrature_points);
      EXPECT_NEAR(m.volume, layers + muscle, 1e-12 * muscle);
      EXPECT_NEAR(m.volume, 3.23160080067e-04, 1e-14); // of Flexodeal
      EXPECT_NEAR(m.mean_pennation, 15.3, 1e-9);
      const auto &space = *system.discretisation().space;
      for (unsigned int face = 0; face < face_names(system.parameters().geometry).size(); ++face)
        {
          dealii::Point<3> low(1, 1, 1), high(-1, -1, -1);
          for (const auto node : space.face_nodes(face))
            for (unsigned int c = 0; c < 3; ++c)
              {
                low[c]  = std::min(low[c], space.node_position(node)[c]);
                high[c] = std::max(high[c], space.node_position(node)[c]);
              }
          EXPECT_LT(((low + high) / 2).distance(face_centre(system.parameters().geometry, face)), face < 6 ? 1e-12 : 2e-3) << face;
        }
    }

    /// F_int . u is the integral of P : Grad u, which the parts of the work density add up to.
    class StressParts : public ::testing::TestWithParam<double>
    {
    };

    TEST_P(StressParts, AddUpToTheInternalForce)
    {
      for (const bool block : {true, false})
        {
          Muscle3dParameters p    = block ? test::small_block() : gastrocnemius();
          p.dynamic               = false;
          p.muscle().fat.fraction = GetParam();
          WorkLedger           ledger;
          const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
          const State          state   = deformed(system);
          const BodyMeasures   m       = measure_body(system, state, SlabRule::quadrature_points);
          const double         by_part = m.work_density.total() * m.volume, whole = residual(system, state) * state.u;
          EXPECT_NEAR(by_part, whole, 1e-12 * std::abs(whole));
          EXPECT_EQ(m.work_density[fat_part] != 0, GetParam() != 0);
          EXPECT_EQ(m.work_density[aponeurosis_fibre] != 0, !block);
          EXPECT_EQ(m.work_density[tendon_fibre], 0.);
        }
    }

    INSTANTIATE_TEST_SUITE_P(Fat, StressParts, ::testing::Values(0., 0.3, 1.));

    class Fields : public ::testing::Test
    {
    protected:
      Vector residual_with(const BodyFields &fields) const
      {
        Muscle3dParameters p = gastrocnemius();
        p.fields             = fields;
        WorkLedger           ledger;
        const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
        return residual(system, deformed(system));
      }

      /// All Gauss points with 4 per direction, last first, in the format of Flexodeal.
      std::filesystem::path table(const bool everything) const
      {
        Muscle3dParameters p = gastrocnemius();
        WorkLedger         ledger;
        p.n_points = 3;
        const Muscle3dSystem     system(p, MPI_COMM_WORLD, ledger);
        const auto              &d = system.discretisation();
        std::vector<std::string> rows;
        for (unsigned int b = 0; b < d.batches->n_owned_batches(); ++b)
          for (unsigned int lane = 0; lane < d.batches->n_filled(b); ++lane)
            for (int q = 0; q < d.element.n_points; ++q)
              {
                const NodeSpace::Cell &cell = d.batches->cell(b, lane);
                const dealii::Point<3> x    = point_position(d.element, cell, q);
                const auto            &a    = p.tissue(cell->material_id()).fibre.direction;
                std::ostringstream     row;
                row.precision(17);
                row << cell->material_id() << "," << x[2] << "," << x[1] << "," << x[0];
                if (everything)
                  row << "," << 2 * a[0] << "," << 2 * a[1] << "," << 2 * a[2] << "," << 2e5 * (1 + x[0]) << "," << x[1] << "," << 1 - x[0];
                rows.push_back(row.str());
              }
        const auto    file = test::temporary(everything ? "points_all.csv" : "points_ids.csv");
        std::ofstream out(file);
        out << "tissue_id,qp_z,qp_y,qp_x"
            << (everything ? ",muscle_fibre_orientation_x,muscle_fibre_orientation_y,muscle_fibre_orientation_z,max_iso_stress_muscle,"
                             "fat_fraction,activation_scale"
                           : "")
            << "\n";
        for (auto row = rows.rbegin(); row != rows.rend(); ++row)
          out << *row << "\n";
        return file;
      }
    };

    TEST_F(Fields, ConstantFormulasChangeNothing)
    {
      BodyFields fields;
      fields.stress           = "200000";
      fields.fat              = "0";
      fields.activation_scale = "1";
      const auto a            = Gastrocnemius().fibre_direction();
      for (unsigned int c = 0; c < 3; ++c)
        {
          std::ostringstream text;
          text.precision(17);
          text << 3 * a[c];
          fields.direction[c] = text.str();
        }
      EXPECT_LT(relative_difference(residual_with(fields), residual_with({})), 1e-13);
    }

    TEST_F(Fields, ATableSaysWhatFormulasSay)
    {
      BodyFields formulas, points, ids;
      formulas.stress           = "2e5*(1+x)";
      formulas.fat              = "y";
      formulas.activation_scale = "1-x";
      points.table              = std::make_shared<PointProperties>(table(true));
      ids.table                 = std::make_shared<PointProperties>(table(false));
      EXPECT_LT(relative_difference(residual_with(points), residual_with(formulas)), 1e-12);
      EXPECT_LT(relative_difference(residual_with(ids), residual_with({})), 1e-13);
      EXPECT_GT(relative_difference(residual_with(points), residual_with({})), 1e-3);
    }

    TEST_F(Fields, WhatCannotBeIsRefused)
    {
      BodyFields fields;
      fields.fat = "2*y/0.055-0.5";
      EXPECT_THROW(residual_with(fields), InputError);
      fields        = {};
      fields.stress = "x-0.1";
      EXPECT_THROW(residual_with(fields), InputError);
      const auto file = test::temporary("points_bad.csv");
      for (const char *text :
           {"qp_x,qp_y,fat_fraction\n0,0,0\n", "qp_x,qp_y,qp_z,fat\n0,0,0,0\n", "qp_x,qp_y,qp_z,fat_fraction\n0,0,0,2\n",
            "qp_x,qp_y,qp_z,fat_fraction\n0,0,0\n", "qp_x,qp_y,qp_z\n", "qp_x,qp_y,qp_z\n0,0,0\n", "qp_x,qp_y,qp_z,tissue_id\n0,0,0,99\n"})
        {
          std::ofstream(file) << text;
          EXPECT_THROW(PointProperties{file}, InputError) << text;
        }
      std::ofstream(file) << "qp_x,qp_y,qp_z,fat_fraction\n5,5,5,0.1\n";
      fields       = {};
      fields.table = std::make_shared<PointProperties>(file);
      EXPECT_THROW(residual_with(fields), InputError); // far from the body
    }
  } // namespace
} // namespace myolines
