// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies from files of meshes, good and bad.
#include "../support/complaint.h"
#include "../support/temporary.h"
#include "fixtures.h"

#include <myolines/base/names.h>
#include <myolines/muscle3d/body_measures.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace myolines
{
  namespace mesh_bodies
  {
    std::filesystem::path written(const std::string &text)
    {
      const auto file = test::temporary("body.msh");
      std::ofstream(file) << text;
      return file;
    }

    std::string refusal(const std::string &text, const std::vector<PlacedFace> &placed = {})
    {
      return test::complaint([&] { MeshBody(written(text), 1, "scene.xml: system/geometry/file", placed); });
    }

    const std::string header = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

    /// A sheared box of 2 x 2 x 3 cells, 30 x 10 x 12 mm, tissues 1 below and 2 above 8 mm, with the surfaces foot and head.
    std::string two_boxes(const std::string &lower = "muscle", const std::string &upper = "tendon")
    {
      std::ostringstream text;
      text << header << "$PhysicalNames\n4\n2 4 \"foot\"\n2 5 \"head\"\n3 2 \"" << lower << "\"\n3 3 \"" << upper
           << "\"\n$EndPhysicalNames\n$Nodes\n36\n";
      const auto number = [](const int i, const int j, const int k) { return 1 + i + 3 * (j + 3 * k); };
      for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i)
            text << number(i, j, k) << " " << 15 * i + 1.5 * j << " " << 5 * j << " " << 4 * k << "\n";
      text << "$EndNodes\n$Elements\n20\n";
      int        element = 0;
      const auto quad    = [&](const int i, const int j, const int k, const std::string &before) {
        text << before << number(i, j, k) << " " << number(i + 1, j, k) << " " << number(i + 1, j + 1, k) << " " << number(i, j + 1, k)
             << " ";
      };
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
          for (int k = 0; k < 4; ++k)
            {
              if (k < 3)
                {
                  quad(i, j, k, std::to_string(++element) + (k < 2 ? " 5 2 2 0 " : " 5 2 3 0 "));
                  quad(i, j, k + 1, "");
                  text << "\n";
                }
              if (k == 0 || k == 3)
                {
                  quad(i, j, k, std::to_string(++element) + (k == 0 ? " 3 2 4 0 " : " 3 2 5 0 "));
                  text << "\n";
                }
            }
      text << "$EndElements\n";
      return text.str();
    }

    Muscle3dParameters parameters_of(const std::shared_ptr<const MeshBody> &body, const unsigned int refinement)
    {
      Muscle3dParameters p;
      p.n_points            = 3;
      p.geometry.mesh       = body;
      p.geometry.refinement = refinement;
      for (unsigned int c = 0; c < 3; ++c)
        p.geometry.size[c] = body->high[c] - body->low[c];
      return p;
    }

    TEST(MeshBodies, TheSystemHasItsVolumeAndItsFaces)
    {
      const auto body = std::make_shared<const MeshBody>(written(two_boxes()), 1e-3, "");
      EXPECT_EQ(body->tissues, (std::vector<std::string>{"muscle", "tendon"}));
      EXPECT_EQ(body->face_names, (std::vector<std::string>{"foot", "head", "rest"}));
      EXPECT_EQ(body->n_named, 2u);
      EXPECT_NEAR(body->volume, 30e-3 * 10e-3 * 12e-3, 1e-18);
      EXPECT_NEAR(body->high[0], 33e-3, 1e-15);
      Muscle3dParameters p = parameters_of(body, 0);
      p.tissues[tendon_id] = tissue_kinds()[tendon_id - 1].defaults;
      WorkLedger           ledger;
      const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      const BodyMeasures   m = measure_body(system, system.initial_state(0), SlabRule::quadrature_points);
      EXPECT_NEAR(m.volume, 30e-3 * 10e-3 * 12e-3, 1e-16);
      EXPECT_EQ(system.discretisation().space->face_nodes(0).size(), 25u); // 2 x 2 quadratic faces
      for (const auto node : system.discretisation().space->face_nodes(1))
        EXPECT_NEAR(system.discretisation().space->node_position(node)[2], 12e-3, 1e-15);
    }

    /// Residual of a state of linear displacements.
    Vector force(const Muscle3dParameters &p)
    {
      WorkLedger           ledger;
      const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      State                state = system.initial_state(0);
      const auto          &space = *system.discretisation().space;
      for (const auto node : space.nodes().locally_owned_dofs())
        for (unsigned int c = 0; c < 3; ++c)
          state.u(3 * node + c) = 0.2 * space.node_position(node)[(c + 1) % 3];
      Vector r = state.u;
      EXPECT_TRUE(system.residual({0, Side::left, state.u, state.v, state.a}, r).admissible);
      return r;
    }

    /// Two muscles in one body: formulas know them by their numbers, and say what formulas of the place say.
    TEST(MeshBodies, VolumesOfATissueMayDiffer)
    {
      const auto body = std::make_shared<const MeshBody>(written(two_boxes("muscle deep", "muscle superficial")), 1e-3, "");
      EXPECT_EQ(body->tissues, (std::vector<std::string>{"muscle"}));
      EXPECT_NE(join(body->report).find("4 cells in volume 3, \"muscle superficial\""), std::string::npos) << join(body->report);
      const auto force_of = [&](const std::string &upper) {
        Muscle3dParameters p      = parameters_of(body, 1);
        p.fields.stress           = upper + " ? 1e5 : 3e5";
        p.fields.direction        = {{upper + " ? 0.6 : 1", "0", upper + " ? 0.8 : 0"}};
        p.fields.activation_scale = upper + " ? 0.5 : 1";
        return force(p);
      };
      const Vector by_place = force_of("z>8e-3");
      Vector       r        = force_of("volume==3");
      r -= by_place;
      EXPECT_LT(r.linfty_norm(), 1e-12 * by_place.linfty_norm());
      r = force_of("volume==2");
      r -= by_place;
      EXPECT_GT(r.linfty_norm(), 1e-3 * by_place.linfty_norm());
    }

    const std::string cube =
        header + "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n$Elements\n";
    const std::string one_hexahedron = cube + "1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n";

    /// A cube of six tetrahedra around its diagonal, with two named ends.
    const std::string six_tetrahedra =
        cube + "10\n1 4 2 1 1 1 2 3 7\n2 4 2 1 1 1 3 4 7\n3 4 2 1 1 1 4 8 7\n4 4 2 1 1 1 8 5 7\n5 4 2 1 1 1 5 6 7\n6 4 2 1 1 1 6 2 7\n"
               "7 2 2 21 21 1 4 8\n8 2 2 21 21 1 8 5\n9 2 2 22 22 2 3 7\n10 2 2 22 22 2 7 6\n$EndElements\n";

    /// Inner forces of a homogeneous state cancel within the body: what is left at the nodes within is rounding, for every degree and so
    /// for every orientation of faces that split cells have.
    TEST(MeshBodies, SplitCellsPassThePatchTest)
    {
      const auto body = std::make_shared<const MeshBody>(written(six_tetrahedra), 0.01, "");
      EXPECT_EQ(body->cells.size(), 24u);
      EXPECT_NEAR(body->volume, 1e-6, 1e-18);
      EXPECT_EQ(body->face_names, (std::vector<std::string>{"21", "22", "rest"}));
      for (const unsigned int degree : {1, 2, 3})
        {
          Muscle3dParameters p = parameters_of(body, 0);
          p.degree             = degree;
          p.n_points           = degree + 2;
          WorkLedger           ledger;
          const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
          const Vector         r      = force(p);
          const auto          &space  = *system.discretisation().space;
          double               inside = 0;
          unsigned int         n      = 0;
          for (const auto node : space.nodes().locally_owned_dofs())
            {
              bool outer = false;
              for (unsigned int c = 0; c < 3; ++c)
                outer = outer || space.node_position(node)[c] < 1e-9 || space.node_position(node)[c] > 0.01 - 1e-9;
              for (unsigned int c = 0; !outer && c < 3; ++c)
                inside = std::max(inside, std::abs(r(3 * node + c)));
              n += outer ? 0 : 1;
            }
          EXPECT_GT(n, 0u);
          EXPECT_LT(inside, 1e-10 * r.linfty_norm()) << "degree " << degree;
        }
    }

    TEST(MeshBodies, WhatIsNoBodyIsRefusedWithItsPlace)
    {
      const auto told = [](const std::string &text, const std::string &words) {
        const std::string what = refusal(text);
        EXPECT_NE(what.find(words), std::string::npos) << what;
      };
      EXPECT_EQ(refusal(one_hexahedron), "");
      EXPECT_EQ(refusal(cube + "1\n1 5 2 1 1 5 6 7 8 1 2 3 4\n$EndElements\n"), "") << "left-handed";
      told(cube + "1\n1 5 2 1 1 1 2 3 4 5 6 8 7\n$EndElements\n", "inverted");
      told(cube + "1\n1 3 2 1 1 1 2 3 4\n$EndElements\n", "has no cells");
      told(two_boxes("muscle", "tendons"), "\"tendons\" is no tissue");
      told(two_boxes("muscle", "bone"), "\"bone\" is no tissue");
      told(cube + "1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n", "has no end");
      EXPECT_NE(test::complaint([] { MeshBody("nowhere.msh", 1, "scene.xml"); }).find("nowhere.msh: there is no such file"),
                std::string::npos);
      // One cell in two tissues; two surfaces that overlap.
      told(cube + "2\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 5 2 3 1 1 2 3 4 5 6 7 8\n$EndElements\n", "belongs to another group, too");
      told(cube + "4\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 3 2 7 7 1 2 3 4\n3 3 2 8 8 1 2 3 4\n4 3 2 8 8 5 6 7 8\n$EndElements\n",
           "in two surfaces: \"7\" and also \"8\"");
      // A cube beside two half ones, whose points hang on its face; and one beside nothing.
      const std::string more = header +
                               "$Nodes\n16\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 2 0 0\n10 2 1 0\n"
                               "11 2 0 0.5\n12 2 1 0.5\n13 1 0 0.5\n14 1 1 0.5\n15 2 0 1\n16 2 1 1\n$EndNodes\n$Elements\n";
      told(more + "3\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 5 2 1 1 2 9 10 3 13 11 12 14\n3 5 2 1 1 13 11 12 14 6 15 16 7\n$EndElements\n",
           "hangs at");
      told(more + "2\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 4 2 1 1 9 10 11 16\n$EndElements\n", "2 parts that do not touch");
    }

    /// The names of tissues in any letters; a single group of another name is all muscle.
    TEST(MeshBodies, GroupsAreTissues)
    {
      EXPECT_EQ(MeshBody(written(two_boxes("MUSCLE_soleus", "Tendon-distal")), 1, "").tissues,
                (std::vector<std::string>{"muscle", "tendon"}));
      std::string label = one_hexahedron;
      label.replace(label.find("5 2 1 1"), 7, "5 2 17 1");
      const MeshBody body(written(label), 1, "");
      const MeshBody twice(written(cube + "3\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 3 2 7 7 1 2 3 4\n3 3 2 8 8 1 2 3 4\n$EndElements\n"), 1, "");
      EXPECT_EQ(twice.face_names, (std::vector<std::string>{"7", "rest"}));
      EXPECT_EQ(twice.further_names, (std::map<std::string, unsigned int>{{"8", 0}})) << "one face of two names";
      std::string ends = cube + "3\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 3 2 7 7 1 2 3 4\n3 3 2 8 8 5 6 7 8\n$EndElements\n";
      ends.insert(ends.find("$Nodes"), "$PhysicalNames\n2\n2 7 \"ends\"\n2 8 \"ends\"\n$EndPhysicalNames\n");
      const MeshBody both(written(ends), 1, "");
      EXPECT_EQ(both.face_names, (std::vector<std::string>{"ends", "rest"})) << "two surfaces of one name are one";
      EXPECT_NE(join(both.report).find("2 quadrilaterals on the face \"ends\""), std::string::npos) << join(both.report);
      EXPECT_EQ(body.tissues, std::vector<std::string>{"muscle"});
      EXPECT_NE(join(body.report).find("is the only one and names no tissue"), std::string::npos) << join(body.report);
    }

    PlacedFace placed(const std::string &name)
    {
      PlacedFace face;
      face.name       = name;
      face.scene_path = "scene.xml: " + name;
      return face;
    }

    TEST(MeshBodies, FacesAreNamedByPlace)
    {
      PlacedFace top = placed("top"), side = placed("side"), low = placed("low");
      top.normal       = dealii::Tensor<1, 3>({0, 0, 1});
      side.normal      = dealii::Tensor<1, 3>({1, 0, 0});
      side.angle       = 89;
      low.normal       = dealii::Tensor<1, 3>({0, 0, -1});
      low.through      = dealii::Point<3>(0, 0, 0);
      low.high[0]      = 15.1;
      std::string bare = two_boxes();
      bare.erase(bare.find("$PhysicalNames"), bare.find("$Nodes") - bare.find("$PhysicalNames"));
      for (std::size_t at = bare.find(" 3 2 "); at != std::string::npos; at = bare.find(" 3 2 ", at + 1))
        bare.replace(at, 7, " 3 2 0 "); // boundary id 0
      for (std::size_t at = bare.find(" 5 2 2 0"); at != std::string::npos; at = bare.find(" 5 2 2 0", at + 1))
        bare.replace(at, 8, " 5 2 1 0");
      const MeshBody           body(written(bare), 1, "", {top, side, low});
      std::vector<std::size_t> n(body.face_names.size());
      for (const auto &quad : body.faces.boundary_quads)
        ++n[quad.boundary_id];
      EXPECT_EQ(body.face_names, (std::vector<std::string>{"top", "side", "low", "rest"}));
      // 4 above; 6 at the end along x; of the four below the two of the lower half; the rest of 2 (4 + 6 + 6).
      EXPECT_EQ(n, (std::vector<std::size_t>{4, 6, 2, 20}));
      side.normal = dealii::Tensor<1, 3>({0, 0, 1});
      EXPECT_NE(refusal(bare, {top, side}).find("scene.xml: side: no part of the boundary is there"), std::string::npos)
          << refusal(bare, {top, side});
      EXPECT_NE(refusal(two_boxes(), {placed("foot")}).find("the mesh has a face of this name"), std::string::npos);
    }
  } // namespace mesh_bodies
} // namespace myolines
