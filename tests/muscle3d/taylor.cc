// SPDX-License-Identifier: LGPL-2.1-or-later
// The linearisation against differences of the residual, at random states of a distorted mesh.
#include "fixtures.h"

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    using test::distort;
    using test::randomise;
    using test::small_block;

    struct Case
    {
      std::string  name;
      unsigned int degree, n_points;
      bool         dynamic = true, active = true;
      std::string  tissue      = "muscle"; ///< of all cells
      double       fat         = 0;
      bool         fields      = false; ///< everything varies in space
      bool         smooth      = false; ///< smooth curves, two regions of activation
      bool         laws        = false; ///< all laws of the list are added
      bool         step        = false; ///< forces of two states
      VolumeForm   volume      = VolumeForm::thesis;
      double       dissipation = 0; ///< of a step

      bool rates() const { return dynamic && (active || laws); }
    };

    void PrintTo(const Case &c, std::ostream *out) { *out << c.name; }

    std::vector<Case> cases()
    {
      std::vector<Case> all{{"q1", 1, 2},
                            {"q2", 2, 3},
                            {"q2_four_points", 2, 4},
                            {"q3", 3, 4},
                            {"quasi_static", 2, 3, false, true},
                            {"passive", 2, 3, true, false},
                            {"fat", 2, 3, true, true, "muscle", 0.3},
                            {"fields", 2, 3, true, true, "muscle", 0, true},
                            {"smooth_curves_and_regions", 2, 3, true, true, "muscle", 0, false, true},
                            {"laws", 2, 3, true, true, "muscle", 0.2, false, false, true},
                            {"laws_of_fields", 1, 2, true, true, "muscle", 0, true, false, true},
                            {"laws_without_activation", 3, 4, true, false, "muscle", 0, false, false, true},
                            {"laws_quasi_static", 2, 3, false, true, "muscle", 0, false, false, true}};
      for (const TissueKind &kind : tissue_kinds())
        if (kind.id != muscle_id)
          all.push_back({kind.name, 2, 3, true, false, kind.name});
      for (const char *name : {"q1", "q2_four_points", "q3", "passive", "fields", "laws", "laws_without_activation", "tendon"})
        {
          Case c = *std::find_if(all.begin(), all.end(), [&](const Case &other) { return other.name == name; });
          c.name = "step_of_" + c.name;
          c.step = true;
          all.push_back(c);
        }
      for (const char *name : {"step_of_q1", "step_of_q3", "step_of_fields", "step_of_laws", "step_of_tendon"})
        {
          Case c        = *std::find_if(all.begin(), all.end(), [&](const Case &other) { return other.name == name; });
          c.name        = std::string("dissipative_") + name;
          c.dissipation = 0.6;
          all.push_back(c);
        }
      for (const VolumeForm form : {VolumeForm::quadratic, VolumeForm::logarithmic})
        for (const bool step : {false, true})
          {
            Case c;
            c.name   = std::string(step ? "step_of_" : "") + volume_form_names[static_cast<int>(form)] + "_volume";
            c.degree = 2, c.n_points = 3;
            c.step   = step;
            c.volume = form;
            all.push_back(c);
          }
      return all;
    }

    class Taylor : public ::testing::TestWithParam<Case>
    {
    protected:
      Taylor()
        : system_(make(), MPI_COMM_WORLD, ledger_)
        , state_(system_.initial_state(0))
      {
        system_.move_mesh(distort);
        state_ = system_.initial_state(0);
        // A smooth deformation with det F from about 0.6 to 1.6, sheared, plus noise. The fibres shorten at a strain rate
        // between the knots -0.25 and 0 of the force-velocity curve, so that differences see smooth laws only.
        const auto  &space    = *system_.discretisation().space;
        const auto  &a0       = system_.parameters().muscle().fibre.direction;
        const double bulge[3] = {0.30, 0.18, 0.13}, size[3] = {0.032, 0.011, 0.012};
        const double factor = GetParam().degree == 1 ? 2. : 1.;
        for (const auto node : space.nodes().locally_owned_dofs())
          {
            const dealii::Point<3> &x     = space.node_position(node);
            const double            along = a0[0] * x[0] + a0[1] * x[1] + a0[2] * x[2];
            for (unsigned int d = 0; d < 3; ++d)
              {
                state_.u(3 * node + d) = factor * bulge[d] * x[d] * (1 - x[d] / size[d]) + 0.05 * x[(d + 1) % 3];
                state_.v(3 * node + d) = -0.5 * along * a0[d];
              }
          }
        Vector noise(state_.u);
        randomise(noise, 1e-5, 1);
        state_.u += noise;
        randomise(noise, 1e-5, 2);
        state_.v += noise;
        randomise(state_.a, 50, 3);
        before_ = state_.u;
        before_ *= 0.8;
      }

      Point point(const State &s) const
      {
        return {0, Side::left, s.u, s.v, s.a, nullptr, GetParam().step ? &before_ : nullptr, GetParam().dissipation};
      }

      static Muscle3dParameters make()
      {
        Muscle3dParameters p = small_block(GetParam().degree, GetParam().n_points);
        p.dynamic            = GetParam().dynamic;
        p.volume_form        = GetParam().volume;
        if (!GetParam().active)
          p.activation = nullptr;
        const auto direction = p.muscle().fibre.direction;
        for (const TissueKind &kind : tissue_kinds())
          if (kind.name == GetParam().tissue)
            p.muscle() = kind.defaults;
        p.muscle().fibre.direction = direction;
        p.muscle().fat.fraction    = GetParam().fat;
        if (GetParam().fields)
          {
            p.fields.stress           = "1e5*(1+50*x)";
            p.fields.fat              = "0.1+10*y";
            p.fields.activation_scale = "1-20*z";
            p.fields.direction        = {{"0.87", "0.1+x", "0.47-2*y"}};
          }
        if (GetParam().laws)
          for (const LawKind &kind : law_kinds())
            p.muscle().laws.push_back({kind.name, kind.make(nullptr), 0.3});
        if (GetParam().smooth)
          {
            p.curves         = std::make_shared<CurveSet>(smooth_curves());
            p.regions        = {{"end", std::make_shared<test::ConstantDrive>(0.2)}};
            p.fields.regions = {"x-0.01"};
          }
        return p;
      }

      Vector residual(const double h, const Weights &w, const Vector &x) const
      {
        State s = state_;
        s.u.add(h * w.u, x);
        s.v.add(h * w.v, x);
        s.a.add(h * w.a, x);
        Vector           r(state_.u);
        const Evaluation evaluation = system_.residual(point(s), r);
        EXPECT_TRUE(evaluation.admissible) << evaluation.reason;
        return r;
      }

      /// |J x - difference| / |difference|, differences of fourth order.
      double error(const Muscle3dSystem &linearised, const Weights &w) const
      {
        Vector x(state_.u), y(state_.u);
        randomise(x, 1, 4);
        const auto linearisation = linearised.make_linearisation();
        linearised.linearise(point(state_), *linearisation);
        linearisation->apply(stage_weights(w.u, w.v, w.a), x, y);

        // Largest change of a node: 1e-7 m, 1e-4 m/s, and any acceleration.
        const double step       = 1 / std::max({w.u / 1e-7, w.v / 1e-5, w.a / 1e3});
        Vector       difference = residual(step, w, x);
        difference -= residual(-step, w, x);
        difference *= 8;
        difference += residual(-2 * step, w, x);
        difference -= residual(2 * step, w, x);
        difference *= 1 / (12 * step);
        y -= difference;
        return y.l2_norm() / difference.l2_norm();
      }

      mutable WorkLedger ledger_;
      Muscle3dSystem     system_;
      State              state_;
      Vector             before_; ///< of a step
    };

    TEST_P(Taylor, StatesCoverTheRange)
    {
      const auto                   &d   = system_.discretisation();
      double                        low = 1e9, high = 0, slowest = -1e9, fastest = 1e9;
      dealii::AlignedVector<double> values(std::size_t(d.element.n_points) * n_point_values * n_lanes);
      const KernelModel             model = kernel_model(system_.parameters(), system_.activation(0));
      const CellSweep               sweep = system_.sweep();
      const dealii::Tensor<1, 3>    a0({system_.parameters().muscle().fibre.direction[0], system_.parameters().muscle().fibre.direction[1],
                                        system_.parameters().muscle().fibre.direction[2]});
      for (unsigned int b = 0; b < d.batches->n_owned_batches(); ++b)
        {
          d.kernels.points(d.tables, model, sweep.cells(b), state_.u.begin(), state_.v.begin(), values.data(), d.scratch());
          for (int q = 0; q < d.element.n_points; ++q)
            for (unsigned int lane = 0; lane < d.batches->n_filled(b); ++lane)
              {
                dealii::Tensor<2, 3> F, rate;
                for (int i = 0; i < 9; ++i)
                  {
                    F[i / 3][i % 3]    = values[(q * n_point_values + point_F + i) * n_lanes + lane];
                    rate[i / 3][i % 3] = values[(q * n_point_values + point_F_rate + i) * n_lanes + lane];
                  }
                const double J = determinant(F), lam = std::pow(J, -1. / 3) * (F * a0).norm();
                const double e = lam * ((F * a0) * (rate * a0) / (F * a0).norm_square() - trace(invert(F) * rate) / 3) / 5;
                low            = std::min(low, J);
                high           = std::max(high, J);
                slowest        = std::max(slowest, e);
                fastest        = std::min(fastest, e);
              }
        }
      EXPECT_LT(low, 0.68);
      EXPECT_GT(low, 0.4);
      EXPECT_GT(high, 1.45);
      EXPECT_LT(slowest, -0.005);
      EXPECT_GT(fastest, -0.245);
    }

    TEST_P(Taylor, Stiffness) { EXPECT_LT(error(system_, {1, 0, 0}), 1e-8); }

    TEST_P(Taylor, Damping)
    {
      if (GetParam().rates())
        {
          // Differences reach over knots of the splines, where third derivatives jump.
          EXPECT_LT(error(system_, {0, 1, 0}), GetParam().smooth ? 1e-7 : 1e-8);
        }
      else
        {
          Vector y(state_.u), x(state_.u);
          randomise(x, 1, 4);
          const auto linearisation = system_.make_linearisation();
          system_.linearise(point(state_), *linearisation);
          linearisation->apply(stage_weights(0, 1, 0), x, y);
          EXPECT_EQ(y.l2_norm(), 0);
        }
    }

    TEST_P(Taylor, Mass)
    {
      if (GetParam().dynamic)
        {
          EXPECT_LT(error(system_, {0, 0, 1}), 1e-8);
        }
    }

    TEST_P(Taylor, Together) { EXPECT_LT(error(system_, {1, 80, 6400}), 1e-8); }

    TEST_P(Taylor, SymmetrisedTangentFails)
    {
      Muscle3dParameters parameters = make();
      parameters.exact_tangent      = false;
      Muscle3dSystem symmetrised(parameters, MPI_COMM_WORLD, ledger_);
      symmetrised.move_mesh(distort);
      const double e = error(symmetrised, {1, 0, 0});
      if (GetParam().step)
        EXPECT_LT(e, 1e-8); // that of a step is always exact
      else if (GetParam().rates())
        EXPECT_GT(e, GetParam().active ? 1e-5 : 5e-8); // fluids are nearly symmetric at these velocities
      else
        EXPECT_LT(e, 1e-8); // without force-velocity nothing is left to symmetrise
    }

    TEST_P(Taylor, AssembledMatrixEqualsAction)
    {
      struct Kind
      {
        bool        exact;
        RateTangent rate;
      };
      for (const Weights &w : {Weights{1, 0, 0}, Weights{0, 1, 0}, Weights{0, 0, 1}, Weights{1, 80, 6400}})
        for (const auto &[exact, rate] : {Kind{true, {}}, Kind{false, {}}, Kind{true, {5, 0, 0}}, Kind{true, {0, 0, -1}}})
          {
            Muscle3dParameters parameters = make();
            parameters.exact_tangent      = exact;
            parameters.rate_tangent       = rate;
            Muscle3dSystem system(parameters, MPI_COMM_WORLD, ledger_);
            system.move_mesh(distort);
            const auto linearisation = system.make_linearisation();
            system.linearise(point(state_), *linearisation);
            const WeightsByOrder weights = stage_weights(w.u, w.v, w.a);
            const SparseMatrix  &matrix  = linearisation->sparse(weights);
            Vector               x(state_.u), y(state_.u), z(state_.u), scale(state_.u);
            randomise(x, 1, 5);
            linearisation->apply(weights, x, y);
            matrix.vmult(z, x);
            y -= z;
            double size = 0; // | |A| |x| |
            for (const auto row : x.locally_owned_elements())
              {
                double sum = 0;
                for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
                  sum += std::abs(entry->value() * x(entry->column()));
                size += sum * sum;
              }
            EXPECT_LE(y.l2_norm(), 1e-13 * std::sqrt(size)) << w.u << " " << w.v << " " << w.a << " exact " << exact;
            if (!exact && !GetParam().step)
              {
                Vector p(state_.u), Ap(state_.u), Ax(state_.u);
                randomise(p, 1, 6);
                matrix.vmult(Ap, p);
                matrix.vmult(Ax, x);
                EXPECT_NEAR(p * Ax, x * Ap, 1e-12 * std::sqrt(size) * p.l2_norm());
              }
          }
    }

    /// All kernels but those of measurements: forces, local unknowns, actions and matrices of the linearisation, patches.
    TEST_P(Taylor, InstructionSetsAgree)
    {
      const WeightsByOrder weights = stage_weights(1, 80, 6400);
      Vector               x(state_.u);
      randomise(x, 1, 7);
      const auto results_of = [&](const InstructionSet set) {
        Muscle3dSystem system(make(), MPI_COMM_WORLD, ledger_, set);
        system.move_mesh(distort);
        std::vector<Vector> results(4, state_.u);
        EXPECT_TRUE(system.residual(point(state_), results[0]).admissible);
        const auto linearisation = system.make_linearisation();
        system.linearise(point(state_), *linearisation);
        linearisation->apply(weights, x, results[1]);
        linearisation->sparse(weights).vmult(results[2], x);
        if (TwoLevel *levels = linearisation->two_level(weights, false))
          {
            levels->patches.invert();
            levels->patches.apply(x, results[3]);
          }
        return results;
      };
      const std::vector<Vector> widest = results_of(widest_instruction_set());
      for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
        if (set < widest_instruction_set())
          {
            std::vector<Vector> results = results_of(set);
            for (std::size_t i = 0; i < results.size(); ++i)
              {
                results[i] -= widest[i]; // factors of patches have half precision but in the baseline
                EXPECT_LE(results[i].l2_norm(), (i == 3 ? 1e-3 : 1e-12) * widest[i].l2_norm()) << name(set) << ", result " << i;
              }
          }
    }

    INSTANTIATE_TEST_SUITE_P(All, Taylor, ::testing::ValuesIn(cases()), [](const auto &info) { return info.param.name; });
  } // namespace
} // namespace myolines
