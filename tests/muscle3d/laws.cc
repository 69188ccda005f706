// SPDX-License-Identifier: LGPL-2.1-or-later
// Tissues as mixes of laws by name: against the printed tissues, energies, parts and what scenes get wrong.
#include "../support/complaint.h"
#include "simulation.h"

#include <myolines/base/error.h>
#include <myolines/muscle3d/body_measures.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    constexpr unsigned int own_id = 4;

    TissuePart part(const std::string &name, const std::string &kind, const std::vector<std::string> &entries = {})
    {
      std::vector<std::string> all{"type=" + kind};
      all.insert(all.end(), entries.begin(), entries.end());
      const scene::Node node = scene::list_of_defaults(*laws_schema().named(), name, all);
      for (const LawKind &of_list : law_kinds())
        if (of_list.name == kind)
          return {name, of_list.make(&node), node.number("weight")};
      throw std::logic_error("no law " + kind);
    }

    /// A block of one tissue of the scene's own.
    Muscle3dParameters own_block(const std::vector<TissuePart> &parts)
    {
      Muscle3dParameters p      = test::small_block();
      TissueParameters  &tissue = p.tissues[own_id];
      tissue                    = p.muscle();
      tissue.fibre.sigma0       = 0;
      tissue.base               = {0, {0, 0, 0}};
      tissue.laws               = parts;
      p.geometry.tissue         = "mine";
      p.geometry.tissue_id      = own_id;
      p.tissue_names.push_back("mine");
      return p;
    }

    /// The thesis' muscle as three laws.
    std::vector<TissuePart> muscle_as_laws()
    {
      return {part("base", "yeoh", {"c1=39811.191502066863", "c2=73246.6965293829804", "c3=0"}), part("passive", "passive fibre"),
              part("active", "active fibre")};
    }

    struct InMotion
    {
      explicit InMotion(const Muscle3dParameters &parameters)
        : system(parameters, MPI_COMM_WORLD, ledger)
        , state(system.initial_state(0))
        , r(state.u)
      {
        const auto &space = *system.discretisation().space;
        for (const auto node : space.nodes().locally_owned_dofs())
          {
            const dealii::Point<3> &x = space.node_position(node);
            for (unsigned int c = 0; c < 3; ++c)
              {
                state.u(3 * node + c) = 0.05 * x[c] * (1.3 - 40 * x[(c + 1) % 3]) + 0.03 * x[(c + 2) % 3];
                state.v(3 * node + c) = -0.4 * x[c] + 0.3 * x[(c + 1) % 3];
              }
          }
        EXPECT_TRUE(system.residual({0, Side::left, state.u, state.v, state.a}, r).admissible);
      }

      Vector action(const Weights &w) const
      {
        Vector x(state.u), y(state.u);
        test::randomise(x, 1, 4);
        const auto linearisation = system.make_linearisation();
        system.linearise({0, Side::left, state.u, state.v, state.a}, *linearisation);
        linearisation->apply(stage_weights(w.u, w.v, w.a), x, y);
        return y;
      }

      WorkLedger     ledger;
      Muscle3dSystem system;
      State          state;
      Vector         r;
    };

    double distance(Vector a, const Vector &b)
    {
      a -= b;
      return a.l2_norm() / b.l2_norm();
    }

    TEST(OwnTissue, OfThePrintedLawsIsThePrintedMuscle)
    {
      for (const bool dynamic : {true, false})
        {
          Muscle3dParameters printed = test::small_block(), own = own_block(muscle_as_laws());
          printed.dynamic = own.dynamic = dynamic;
          const InMotion theirs(printed), ours(own);
          EXPECT_LT(distance(ours.r, theirs.r), 1e-12);
          EXPECT_LT(distance(ours.action({1, 0, 0}), theirs.action({1, 0, 0})), 1e-12);
          EXPECT_LT(distance(ours.action({1, 80, 6400}), theirs.action({1, 80, 6400})), 1e-12);
          const BodyMeasures a = measure_body(ours.system, ours.state, SlabRule::quadrature_points),
                             b = measure_body(theirs.system, theirs.state, SlabRule::quadrature_points);
          EXPECT_NEAR(a.stored_laws, b.stored_base + b.stored_passive, 1e-12 * a.stored_laws);
          EXPECT_EQ(a.stored_base + a.stored_passive + a.stored_tendinous, 0);
          EXPECT_NEAR(a.active_power, b.active_power, 1e-12 * std::abs(b.active_power));
          EXPECT_NEAR(a.dissipation, b.dissipation, 1e-12 * std::abs(b.dissipation));
          EXPECT_NEAR(a.work_density.laws.at(0), b.work_density[muscle_base], 1e-12 * std::abs(b.work_density[muscle_base]));
          EXPECT_NEAR(a.work_density.laws.at(1), b.work_density[muscle_passive], 1e-12 * std::abs(b.work_density[muscle_passive]));
          EXPECT_NEAR(a.work_density.laws.at(2), b.work_density[muscle_active], 1e-12 * std::abs(b.work_density[muscle_active]));
        }
    }

    TEST(OwnTissue, HasPartsUnderItsOwnNamesAndNoOthers)
    {
      const Muscle3dParameters p = own_block({part("wall", "guccione"), part("fluid", "viscosity")});
      ASSERT_EQ(p.law_parts().size(), 2u);
      EXPECT_EQ(p.law_parts()[0].name, "mine wall");
      EXPECT_EQ(p.law_parts()[1].name, "mine fluid");
      const InMotion     body(p);
      const BodyMeasures m = measure_body(body.system, body.state, SlabRule::quadrature_points);
      for (unsigned int part = volumetric_part + 1; part < n_stress_parts; ++part)
        EXPECT_EQ(m.work_density.part[part], 0) << part; // not even tendon
      for (const double of_law : m.work_density.laws)
        EXPECT_NE(of_law, 0);
      EXPECT_NEAR(m.work_density.total() * m.volume, body.r * body.state.u, 1e-12 * std::abs(body.r * body.state.u));
    }

    /// All laws of the list in each of three tissues, which a formula spreads over the block; each part weighs 1 - fat in the muscle.
    TEST(Laws3d, InSeveralTissuesAreSumsOverTheirPoints)
    {
      Muscle3dParameters p = own_block(muscle_as_laws());
      for (const LawKind &kind : law_kinds())
        p.muscle().laws.push_back({kind.name, kind.make(nullptr), 0.5});
      p.tissues[tendon_id]                 = tissue_kinds()[tendon_id - 1].defaults;
      p.tissues[tendon_id].laws            = {part("fluid", "fibre viscosity", {"viscosity=3000", "weight=2"})};
      p.tissues[tendon_id].fibre.direction = p.muscle().fibre.direction;
      p.fields.fat                         = "0.1+10*y";
      p.fields.tissue                      = "x<0.01 ? 1 : (y<0.005 ? 3 : 4)";
      const InMotion     body(p);
      const BodyMeasures m = measure_body(body.system, body.state, SlabRule::quadrature_points);
      EXPECT_EQ(m.work_density.laws.size(), law_kinds().size() + 1 + 3);
      EXPECT_NEAR(m.work_density.total() * m.volume, body.r * body.state.u, 1e-12 * std::abs(body.r * body.state.u));
      // the action is the derivative of the residual
      Vector x(body.state.u);
      test::randomise(x, 1, 4);
      const double h        = 1e-8;
      const auto   residual = [&](const double by) {
        Vector u = body.state.u, r = body.state.u;
        u.add(by, x);
        EXPECT_TRUE(body.system.residual({0, Side::left, u, body.state.v, body.state.a}, r).admissible);
        return r;
      };
      Vector difference = residual(h);
      difference -= residual(-h);
      difference *= 1 / (2 * h);
      EXPECT_LT(distance(body.action({1, 0, 0}), difference), 1e-6);
    }

    /// dE/dt + dissipation - active power = r v at any state without inertia's part.
    TEST(Laws3d, EnergiesAndDissipationAreThoseOfTheResidual)
    {
      Muscle3dParameters p = own_block(muscle_as_laws());
      p.tissues[own_id].laws.push_back(part("wall", "guccione"));
      p.tissues[own_id].laws.push_back(part("fluid", "viscosity"));
      p.tissues[own_id].laws.push_back(part("dashpot", "fibre viscosity"));
      const InMotion body(p);
      const auto     measures = [&](const double h) {
        State moved = body.state;
        moved.u.add(h, body.state.v);
        return measure_body(body.system, moved, SlabRule::quadrature_points);
      };
      const auto stored = [&](const double h) {
        const BodyMeasures m = measures(h);
        return m.stored_volumetric + m.stored_laws;
      };
      const double       h = 1e-5;
      const BodyMeasures m = measures(0);
      EXPECT_GT(m.dissipation, 0);
      EXPECT_NE(m.active_power, 0);
      EXPECT_NEAR((stored(h) - stored(-h)) / (2 * h), m.active_power - m.dissipation + body.r * body.state.v,
                  1e-7 * std::abs(body.r * body.state.v));
      const Powers powers = measure_powers(body.system, body.state);
      EXPECT_DOUBLE_EQ(powers.active_power, m.active_power);
      EXPECT_DOUBLE_EQ(powers.dissipation, m.dissipation);
    }

    /// A block swollen by a tenth in all directions: pressures of all points, energy, and the name in a scene.
    TEST(VolumetricEnergy, IsTheOneThatTheSceneNames)
    {
      const double kappa = 4e6, D = 1.331, ln = std::log(D);
      const struct
      {
        const char *name;
        double      pressure, energy;
      } forms[] = {{"thesis", kappa / 2 * (D - 1 / D), kappa / 4 * (D * D - 2 * ln - 1)},
                   {"quadratic", kappa * (D - 1), kappa / 2 * (D - 1) * (D - 1)},
                   {"logarithmic", kappa * ln / D, kappa / 2 * ln * ln}};
      for (const auto &form : forms)
        {
          const std::string        scene = "<ParameterList name=\"scene\"/>";
          const Muscle3dParameters p     = read_muscle3d(scene::parse_scene(
                  scene, muscle3d_schema(), "test", ".",
                  {std::string("tissues/volumetric energy=") + form.name, "tissues/muscle/bulk modulus=4e6", "geometry/refinement=0"}));
          InMotion                 body(p);
          const auto              &space = *body.system.discretisation().space;
          for (const auto node : space.nodes().locally_owned_dofs())
            for (unsigned int c = 0; c < 3; ++c)
              body.state.u(3 * node + c) = 0.1 * space.node_position(node)[c];
          body.state.v         = 0;
          const BodyMeasures m = measure_body(body.system, body.state, SlabRule::quadrature_points);
          EXPECT_NEAR(m.stored_volumetric, form.energy * m.volume, 1e-12 * form.energy * m.volume) << form.name;
          // what the pressure does against the displacement: p J H : Grad U = 3 p J 0.1/1.1
          EXPECT_NEAR(m.work_density[volumetric_part], 3 * form.pressure * D * 0.1 / 1.1, 1e-11 * form.pressure) << form.name;
        }
    }

    TEST(Laws3d, AnExponentialThatOverflowsIsInadmissible)
    {
      const InMotion body(own_block({part("wall", "guccione", {"bf=1e6"})}));
      Vector         u = body.state.u, r(u);
      u *= 5;
      const Evaluation evaluation = body.system.residual({0, Side::left, u, body.state.v, body.state.a}, r);
      EXPECT_FALSE(evaluation.admissible);
      EXPECT_NE(evaluation.reason.find("a stress not finite"), std::string::npos) << evaluation.reason;
    }

    std::string told(const std::vector<std::string> &entries, const std::string &own)
    {
      const std::string tissues =
          "<ParameterList name=\"scene\"><ParameterList name=\"tissues\">" + own + "</ParameterList></ParameterList>";
      return test::complaint([&] { read_muscle3d(scene::parse_scene(tissues, muscle3d_schema(), "test", ".", entries)); });
    }

    std::string list(const std::string &name, const std::string &inside)
    {
      return "<ParameterList name=\"" + name + "\">" + inside + "</ParameterList>";
    }

    TEST(OwnTissue, IsReadFromAScene)
    {
      const std::string wall  = list("wall", "<Parameter name=\"type\" type=\"string\" value=\"guccione\"/>"),
                        fluid = list("fluid", "<Parameter name=\"type\" type=\"string\" value=\"viscosity\"/>"),
                        mine = list("own", list("mine", list("laws", wall))), wet = list("own", list("mine", list("laws", wall + fluid)));
      EXPECT_EQ(told({"geometry/tissue=mine"}, mine), "");
      EXPECT_EQ(told({"geometry/tissue=mine"}, wet), "");
      EXPECT_EQ(told({"fields/tissue=x<0.01 ? 4 : 1"}, mine), "");
      EXPECT_EQ(told({}, list("muscle", list("laws", fluid))), "");
      EXPECT_NE(told({}, mine).find("the body has no cells of mine"), std::string::npos);
      EXPECT_NE(told({"geometry/tissue=min"}, mine).find("\"min\" is no tissue"), std::string::npos);
      EXPECT_NE(told({"geometry/tissue=mine", "inertia=quasi-static"}, wet).find("law of strain rates alone"), std::string::npos);
      EXPECT_NE(told({"geometry/tissue=mine"}, list("own", list("mine", ""))).find("has no law"), std::string::npos);
      EXPECT_NE(told({}, list("own", list("tendon", list("laws", wall)))).find("printed tissue"), std::string::npos);
      EXPECT_NE(told({"geometry/tissue=mine"}, mine + list("muscle", "<Parameter name=\"density\" type=\"double\" value=\"1000\"/>"))
                    .find("no cells of muscle"),
                std::string::npos);
      std::string many;
      for (int i = 0; i < 13; ++i)
        many += list("t" + std::to_string(i), list("laws", wall));
      EXPECT_NE(told({"fields/tissue=1"}, list("own", many)).find("one tissue too many"), std::string::npos);
    }
  } // namespace
} // namespace myolines
