// Bodies from Gmsh files, good and bad.
#include "../support/temporary.h"
#include "fixtures.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/muscle3d/measurements.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmsh.h>

namespace myolines
{
  namespace
  {
    class Gmsh : public ::testing::Test
    {
    protected:
      Gmsh()
        : folder_(test::temporary("gmsh"))
      {
        std::filesystem::create_directories(folder_);
      }
      ~Gmsh() override { std::filesystem::remove_all(folder_); }

      /// Two boxes on top of each other, 8 mm of volume 1 below and 4 mm of volume 2 above, by Gmsh itself.
      std::filesystem::path two_boxes(const double version, const bool binary, const std::string &lower_name = "muscle",
                                      const std::string &upper_name = "tendon", const std::string &both_name = "") const
      {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::model::add("boxes");
        std::vector<int> lines, layers;
        const int        a = gmsh::model::geo::addPoint(0, 0, 0), b = gmsh::model::geo::addPoint(30, 0, 0),
                  c = gmsh::model::geo::addPoint(33, 10, 0), d = gmsh::model::geo::addPoint(3, 10, 0);
        for (const auto &[from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, d), std::pair(d, a)})
          lines.push_back(gmsh::model::geo::addLine(from, to));
        const int base = gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop(lines)});
        for (const int line : lines)
          gmsh::model::geo::mesh::setTransfiniteCurve(line, 3);
        gmsh::model::geo::mesh::setTransfiniteSurface(base);
        gmsh::model::geo::mesh::setRecombine(2, base);
        gmsh::vectorpair lower, upper;
        gmsh::model::geo::extrude({{2, base}}, 0, 0, 8, lower, {2}, {}, true);
        gmsh::model::geo::extrude({lower[0]}, 0, 0, 4, upper, {1}, {}, true);
        gmsh::model::geo::synchronize();
        const auto group = [](const int dimension, const int entity, const std::string &name) {
          gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, {entity}), name);
        };
        group(3, lower[1].second, lower_name);
        group(3, upper[1].second, upper_name);
        group(2, base, "foot");
        group(2, upper[0].second, "head");
        if (!both_name.empty())
          gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {lower[1].second, upper[1].second}), both_name);
        gmsh::model::mesh::generate(3);
        gmsh::option::setNumber("Mesh.MshFileVersion", version);
        gmsh::option::setNumber("Mesh.Binary", binary ? 1 : 0);
        const auto file = folder_ / "boxes.msh";
        gmsh::write(file.string());
        gmsh::finalize();
        return file;
      }

      std::filesystem::path write(const std::string &text) const
      {
        const auto file = folder_ / "bad.msh";
        std::ofstream(file) << text;
        return file;
      }

      std::string refusal(const std::filesystem::path &file) const
      {
        try
          {
            GmshBody(file, 1, "scene.xml: system/geometry/file");
          }
        catch (const InputError &error)
          {
            return error.what();
          }
        return "";
      }

      std::filesystem::path folder_;
    };

    TEST_F(Gmsh, EveryVersionAndEncodingIsTheSameBody)
    {
      for (const double version : {2.2, 4.1})
        for (const bool binary : {false, true})
          {
            const GmshBody body(two_boxes(version, binary), 1e-3, "");
            EXPECT_EQ(body.cells.size(), 12u);
            EXPECT_EQ(body.tissues, (std::vector<std::string>{"muscle", "tendon"}));
            EXPECT_EQ(body.face_names, (std::vector<std::string>{"foot", "head"}));
            EXPECT_NEAR(body.volume, 30e-3 * 10e-3 * 12e-3, 1e-18);
            EXPECT_NEAR(body.high[0], 33e-3, 1e-15);
          }
    }

    TEST_F(Gmsh, TheSystemHasItsVolumeAndItsFaces)
    {
      Muscle3dParameters p;
      p.n_points            = 3;
      p.geometry.gmsh       = std::make_shared<const GmshBody>(two_boxes(2.2, false), 1e-3, "");
      p.geometry.refinement = 0;
      p.geometry.size       = {{33e-3, 10e-3, 12e-3}};
      p.tissues[tendon_id]  = tissue_kinds()[tendon_id - 1].defaults;
      WorkLedger           ledger;
      const Muscle3dSystem system(p, MPI_COMM_WORLD, ledger);
      const BodyMeasures   m = measure_body(system, system.initial_state(0), SlabRule::quadrature_points);
      EXPECT_NEAR(m.volume, 30e-3 * 10e-3 * 12e-3, 1e-16);
      EXPECT_EQ(system.discretisation().space->face_nodes(0).size(), 25u); // 2 x 2 quadratic faces
      for (const auto node : system.discretisation().space->face_nodes(1))
        EXPECT_NEAR(system.discretisation().space->node_position(node)[2], 12e-3, 1e-15);
    }

    /// Two muscles in one body: formulas know them by their numbers, and say what formulas of the place say.
    TEST_F(Gmsh, VolumesOfATissueMayDiffer)
    {
      const auto body = std::make_shared<const GmshBody>(two_boxes(4.1, true, "muscle deep", "muscle superficial"), 1e-3, "");
      EXPECT_EQ(body->tissues, (std::vector<std::string>{"muscle"}));
      EXPECT_NE(join(body->report).find("4 cells in volume 2, \"muscle superficial\""), std::string::npos) << join(body->report);
      const auto force = [&](const std::string &upper) {
        Muscle3dParameters p;
        p.n_points                = 3;
        p.geometry.gmsh           = body;
        p.geometry.refinement     = 1;
        p.geometry.size           = {{33e-3, 10e-3, 12e-3}};
        p.fields.stress           = upper + " ? 1e5 : 3e5";
        p.fields.direction        = {{upper + " ? 0.6 : 1", "0", upper + " ? 0.8 : 0"}};
        p.fields.activation_scale = upper + " ? 0.5 : 1";
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
      };
      const Vector by_place = force("z>8e-3");
      Vector       r        = force("volume==2");
      r -= by_place;
      EXPECT_LT(r.linfty_norm(), 1e-12 * by_place.linfty_norm());
      r = force("volume==3");
      r -= by_place;
      EXPECT_GT(r.linfty_norm(), 1e-3 * by_place.linfty_norm());
    }

    TEST_F(Gmsh, WhatIsNoBodyIsRefusedWithItsPlace)
    {
      const std::string header = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
      const std::string cube   = header + "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n";
      EXPECT_EQ(refusal(write(cube + "$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n")), "");
      EXPECT_NE(refusal(write(cube + "$Elements\n1\n1 5 2 1 1 5 6 7 8 1 2 3 4\n$EndElements\n")).find("inverted"), std::string::npos);
      EXPECT_NE(refusal(write(cube + "$Elements\n1\n1 4 2 1 1 1 2 3 5\n$EndElements\n")).find("Tetrahedron"), std::string::npos);
      EXPECT_NE(refusal(write(cube + "$Elements\n1\n1 5 2 9 1 1 2 3 4 5 6 7 8\n$EndElements\n")).find("no tissue"), std::string::npos);
      EXPECT_NE(refusal(two_boxes(4.1, false, "muscles")).find("is no tissue"), std::string::npos);
      EXPECT_NE(refusal(two_boxes(4.1, false, "muscle a", "muscle b", "muscle")).find("belongs to another group"), std::string::npos);
      EXPECT_NE(refusal(folder_ / "nowhere.msh").find("nowhere.msh: there is no such file"), std::string::npos);
      // A cube beside two half ones: the nodes between them hang on its face; and two cubes that are not joined.
      const std::string more = header +
                               "$Nodes\n16\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 2 0 0\n10 2 1 0\n"
                               "11 2 0 0.5\n12 2 1 0.5\n13 1 0 0.5\n14 1 1 0.5\n15 2 0 1\n16 2 1 1\n$EndNodes\n$Elements\n";
      EXPECT_NE(
          refusal(
              write(more + "3\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 5 2 1 1 2 9 10 3 13 11 12 14\n3 5 2 1 1 13 11 12 14 6 15 16 7\n$EndElements\n"))
              .find("hangs"),
          std::string::npos);
    }

    /// A cube of one element, for what stands around a mesh.
    const std::string one_cube = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n"
                                 "6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n";

    TEST_F(Gmsh, NoFileIsExecuted)
    {
      const auto        mark    = folder_ / "executed";
      const std::string touch   = "SystemCall \"touch " + mark.string() + "\";\n";
      const std::string printed = "Printf(\"x\") > \"" + mark.string() + "\";\n";
      for (const std::string script : {touch, printed, "// a mesh\n" + touch, "\n\n" + touch, std::string("Exit;\n"),
                                       "Include \"" + write(one_cube).string() + "\";\n", "$MeshFormats\n" + touch,
                                       "$Comments\n$EndComments\n" + touch, touch + one_cube})
        EXPECT_NE(refusal(write(script)).find("this is no mesh of Gmsh"), std::string::npos) << script;
      // Behind, between and inside of a mesh it is left out.
      const std::size_t nodes = one_cube.find("$Nodes");
      for (const std::string &around : {one_cube + touch + printed + "Exit;\n", one_cube.substr(0, nodes) + touch + one_cube.substr(nodes),
                                        one_cube + "$View\n" + touch + "$EndView\n"})
        EXPECT_EQ(refusal(write(around)), "") << around;
      // Options that Gmsh looks for beside a file.
      std::ofstream(write(one_cube).string() + ".opt") << touch;
      EXPECT_EQ(refusal(write(one_cube)), "");
      EXPECT_FALSE(std::filesystem::exists(mark));
    }

    TEST_F(Gmsh, WhatOtherProgramsPutAroundAMeshIsNoMatter)
    {
      std::string windows;
      for (const char c : one_cube)
        windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
      EXPECT_EQ(refusal(write(windows)), "");
      EXPECT_EQ(refusal(write("\xEF\xBB\xBF" + one_cube)), "") << "a byte order mark";
      EXPECT_EQ(refusal(write("$NOD\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$ENDNOD\n"
                              "$ELM\n1\n1 5 1 1 8 1 2 3 4 5 6 7 8\n$ENDELM\n")),
                "")
          << "version 1";
    }

    TEST_F(Gmsh, WhatCannotBeWholeIsRefusedBeforeItIsRead)
    {
      EXPECT_NE(refusal(write(one_cube.substr(0, one_cube.size() - 10))).find("cut off"), std::string::npos);
      std::string large = one_cube;
      large.replace(large.find("$Nodes\n8"), 8, "$Nodes\n4000000000000");
      EXPECT_NE(refusal(write(large)).find("cannot hold"), std::string::npos);
      large.replace(large.find("2.2 0 8"), 7, "9.9 0 8");
      EXPECT_NE(refusal(write(large)).find("format \"9.9 0 8\" is not known"), std::string::npos);
      EXPECT_NE(refusal(folder_).find("it is a folder"), std::string::npos);
      EXPECT_NE(refusal("/dev/zero").find("it is a device"), std::string::npos);
    }
  } // namespace
} // namespace myolines
