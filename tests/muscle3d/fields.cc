// SPDX-License-Identifier: LGPL-2.1-or-later
// Fractions of extracellular matrix and tissues that vary within a block, against closed forms and between formulas and tables.
#include "../support/solvers.h"
#include "../support/temporary.h"
#include "fixtures.h"

#include <myolines/base/error.h>
#include <myolines/muscle3d/body_measures.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace myolines
{
  namespace
  {
    Muscle3dParameters mixed_block()
    {
      Muscle3dParameters p                      = test::small_block();
      p.dynamic                                 = false;
      p.muscle().bulk_modulus                   = 1e6;
      p.muscle().base                           = {1, {3703, -707, 123}};
      p.muscle().matrix                         = MatrixParameters{0.05, 3e6, {200, {1988, 4917, -591}}};
      p.tissues[aponeurosis_id]                 = tissue_kinds()[aponeurosis_id - 1].defaults;
      p.tissues[aponeurosis_id].fibre.direction = p.muscle().fibre.direction;
      return p;
    }

    struct Deformed
    {
      explicit Deformed(const Muscle3dParameters &parameters)
        : system(parameters, MPI_COMM_WORLD, ledger)
        , state(system.initial_state(0))
        , r(state.u)
      {
        const auto &space = *system.discretisation().space;
        for (const auto node : space.nodes().locally_owned_dofs())
          {
            const dealii::Point<3> &x = space.node_position(node);
            for (unsigned int c = 0; c < 3; ++c)
              state.u(3 * node + c) = 0.05 * x[c] * (1.3 - 40 * x[(c + 1) % 3]) + 0.03 * x[(c + 2) % 3];
          }
        EXPECT_TRUE(system.residual({0, Side::left, state.u, state.v, state.a}, r).admissible);
      }

      double distance(const Deformed &other) const
      {
        Vector d = r;
        d -= other.r;
        return d.l2_norm() / r.l2_norm();
      }

      WorkLedger     ledger;
      Muscle3dSystem system;
      State          state;
      Vector         r;
    };

    Deformed with_fields(const std::string &matrix, const std::string &tissue = "")
    {
      Muscle3dParameters p = mixed_block();
      p.fields.matrix      = matrix;
      p.fields.tissue      = tissue;
      return Deformed(p);
    }

    /// What a table says of all Gauss points.
    Deformed with_table(const std::string &column, const std::function<double(const dealii::Point<3> &)> &value)
    {
      Muscle3dParameters p    = mixed_block();
      const Deformed     at   = Deformed(p);
      const auto        &d    = at.system.discretisation();
      const auto         file = test::temporary(column + ".csv");
      std::ofstream      out(file);
      out.precision(17);
      out << "qp_x,qp_y,qp_z," << column << "\n";
      for (unsigned int b = 0; b < d.batches->n_owned_batches(); ++b)
        for (unsigned int lane = 0; lane < d.batches->n_filled(b); ++lane)
          for (int q = 0; q < d.element.n_points; ++q)
            {
              const dealii::Point<3> x = point_position(d.element, d.batches->cell(b, lane), q);
              out << x[0] << "," << x[1] << "," << x[2] << "," << value(x) << "\n";
            }
      out.close();
      p.fields.table = std::make_shared<PointProperties>(file);
      return Deformed(p);
    }

    TEST(MatrixFraction, MixesEnergiesAndBulkModuli)
    {
      const Muscle3dParameters p = mixed_block();
      const Material           m = material(p.muscle());
      EXPECT_DOUBLE_EQ(m[material_bulk], 0.05 * 3e6 + 0.95 * 1e6);
      EXPECT_DOUBLE_EQ(m[material_yeoh], 0.05 * 200 * 1988 + 0.95 * 3703);
      EXPECT_DOUBLE_EQ(m[material_yeoh + 2], 0.05 * 200 * -591 + 0.95 * 123);
      TissueParameters fat = p.muscle();
      fat.fat.fraction     = 0.4;
      EXPECT_DOUBLE_EQ(material(fat)[material_bulk], 0.6 * m[material_bulk] + 0.4 * 1e7);
    }

    TEST(MatrixFraction, ConstantFormulaIsTheTissue)
    {
      EXPECT_LT(with_fields("0.05").distance(Deformed(mixed_block())), 1e-14);
      Muscle3dParameters p = mixed_block(), cells = mixed_block();
      p.muscle().matrix->fraction = 0;
      cells.muscle().matrix.reset();
      EXPECT_LT(Deformed(p).distance(Deformed(cells)), 1e-14);
      EXPECT_GT(Deformed(mixed_block()).distance(Deformed(cells)), 1e-3);
    }

    TEST(MatrixFraction, ATableSaysWhatAFormulaSays)
    {
      const Deformed formula = with_fields("0.02+10*x*y/0.03");
      EXPECT_LT(with_table("matrix_fraction", [](const dealii::Point<3> &x) { return 0.02 + 10 * x[0] * x[1] / 0.03; }).distance(formula),
                1e-12);
      EXPECT_GT(formula.distance(Deformed(mixed_block())), 1e-4);
    }

    /// The base part of the stress knows the mix of its point.
    TEST(MatrixFraction, StressPartsAddUpToTheInternalForce)
    {
      Muscle3dParameters p = mixed_block();
      p.fields.matrix      = "30*x";
      p.fields.fat         = "20*y";
      const Deformed     body(p);
      const BodyMeasures m = measure_body(body.system, body.state, SlabRule::quadrature_points);
      EXPECT_NEAR(m.work_density.total() * m.volume, body.r * body.state.u, 1e-12 * std::abs(body.r * body.state.u));
      EXPECT_GT(std::abs(m.work_density[muscle_base] * m.volume), 1e-3 * std::abs(body.r * body.state.u));
    }

    TEST(TissueFormula, IsWhatATableOfTissuesIs)
    {
      const Deformed formula = with_fields("", "x<0.011 ? 2 : 1");
      EXPECT_LT(with_table("tissue_id", [](const dealii::Point<3> &x) { return x[0] < 0.011 ? 2. : 1.; }).distance(formula), 1e-13);
      EXPECT_GT(formula.distance(Deformed(mixed_block())), 1e-2);
      const BodyMeasures m = measure_body(formula.system, formula.state, SlabRule::quadrature_points);
      EXPECT_NE(m.work_density[aponeurosis_fibre], 0.);
      EXPECT_NE(m.work_density[muscle_active], 0.);
    }

    TEST(FieldsOfABlock, WhatCannotBeIsRefused)
    {
      EXPECT_THROW(with_fields("2*x/0.03"), InputError);            // beyond 1
      EXPECT_THROW(with_fields("", "1.5"), InputError);             // no tissue
      EXPECT_THROW(with_fields("", "x<0.011 ? 3 : 1"), InputError); // tendon has no list
      const auto read = [](const std::vector<std::string> &settings) { return read_muscle3d(testing::node(muscle3d_schema(), settings)); };
      EXPECT_THROW(read({"fields/matrix fraction=0.1"}), InputError);
      EXPECT_TRUE(read({"fields/matrix fraction=0.1", "tissues/muscle/base/type=matrix and cells"}).fields.has_matrix());
      EXPECT_THROW(read({"tissues/tendon/density=1000"}), InputError);
      EXPECT_EQ(read({"tissues/tendon/density=1000", "fields/tissue=x<0.01 ? 3 : 1"}).tissues.count(tendon_id), 1u);
    }
  } // namespace
} // namespace myolines
