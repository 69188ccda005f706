// SPDX-License-Identifier: LGPL-2.1-or-later
// Files of Gmsh: every version and encoding is the same mesh; damaged ones are refused with their place.
#include "gmsh_texts.h"

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    std::map<std::string, std::string> all_versions()
    {
      using namespace test;
      return {{"1", gmsh_1()},
              {"2.2", gmsh_2()},
              {"2.2 binary", gmsh_2_binary(false)},
              {"2.2 binary, other order", gmsh_2_binary(true)},
              {"4.0", gmsh_4(false, false)},
              {"4.0 binary", gmsh_4(false, true)},
              {"4.1", gmsh_4(true, false)},
              {"4.1 binary", gmsh_4(true, true)},
              {"4.1 binary, other order", gmsh_4(true, true, true)},
              {"4.0 partitioned", gmsh_4(false, false, false, true)},
              {"4.1 partitioned", gmsh_4(true, false, false, true)},
              {"4.0 partitioned, binary", gmsh_4(false, true, false, true)},
              {"4.1 partitioned, binary", gmsh_4(true, true, false, true)}};
    }

    TEST(GmshFiles, EveryVersionAndEncodingIsTheSameMesh)
    {
      for (const auto &[name, text] : all_versions())
        {
          const PlainMesh mesh = test::mesh_of(text);
          EXPECT_EQ(test::difference_from_two_cubes(mesh), "") << name;
          if (name == "1")
            continue;
          EXPECT_EQ(mesh.cell_groups.at(2), "tendon") << name;
          EXPECT_EQ(mesh.face_groups.at(12), "far end") << name;
        }
    }

    /// Cut off anywhere, or with any byte changed, a file is read or refused.
    TEST(GmshFiles, NoDamageDoesAnyHarm)
    {
      std::size_t refused = 0;
      for (const auto &[name, text] : all_versions())
        for (std::size_t n = 0; n < text.size(); n += 5)
          {
            if (n + 12 < text.size())
              {
                EXPECT_NE(test::refusal_of(text.substr(0, n)), "") << name << " cut off at " << n;
              }
            std::string changed = text;
            changed[n]          = static_cast<char>(changed[n] ^ (n % 2 == 0 ? 0x80 : 0x15));
            refused += test::refusal_of(changed).empty() ? 0 : 1;
          }
      EXPECT_GT(refused, 500u);
    }

    TEST(GmshFiles, RefusalsNameThePlace)
    {
      const auto replaced = [](std::string text, const std::string &what, const std::string &by) {
        text.replace(text.find(what), what.size(), by);
        return text;
      };
      const std::string text = test::gmsh_2();
      const auto        told = [&](const std::string &what, const std::string &by, const std::string &words) {
        const std::string refusal = test::refusal_of(replaced(text, what, by));
        EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
      };
      told("2.2 0 8", "9.9 0 8", "the format \"9.9 0 8\" is not known");
      told("10 1.25 0 0", "10 1.25 zero 0", "line 14: \"zero\" stands where a coordinate should be");
      told("10 1.25 0 0", "10 nan 0 0", "\"nan\" stands where a coordinate should be");
      told("$Nodes\n12", "$Nodes\n4000000000000", "which the");
      told("3 5 4 1 0 1 1 5 ", "3 5 4 1 0 1 1 6 ", "has the point 6, which is not in the file");
      told("3 5 4 1", "3 99 4 1", "elements of type 99 are not known");
      told("$EndElements", "$End", "has no end: the file is cut off");
      told("$Nodes\n12", "$Nodes\n11", "the section $Nodes has more than the number at its beginning announces");
      told("$EndElements", "9 3 2 11 1 5 20 50 35\n$EndElements", "the section $Elements has more");
      told("15 2.5 0 0", "5 2.5 0 0", "the point 5 is there twice");
      std::string binary = test::gmsh_4(true, true);
      binary.resize(binary.size() - 60);
      EXPECT_NE(test::refusal_of(binary).find("byte"), std::string::npos) << test::refusal_of(binary);
    }

    /// What stands around the sections of a mesh is no matter: nothing of it is executed.
    TEST(GmshFiles, ScriptsAreLeftOut)
    {
      const std::string text = test::gmsh_2(), script = "SystemCall \"touch executed\";\n//+\nShow \"*\";\n";
      const std::size_t nodes = text.find("$Nodes");
      for (const std::string &around : {text + script, "$Comments\n" + script + "$EndComments\n" + text,
                                        text.substr(0, nodes) + script + text.substr(nodes), text + "$View\n" + script + "$EndView\n"})
        EXPECT_EQ(test::difference_from_two_cubes(test::mesh_of(around)), "");
      std::string windows;
      for (const char c : text)
        windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
      EXPECT_EQ(test::difference_from_two_cubes(test::mesh_of(windows)), "");
      for (const std::string &no_mesh :
           {script, script + text, "$Comment\n" + script + text, "$MeshFormats\n" + script, std::string("ELEMENT\n"), std::string("{}")})
        EXPECT_NE(test::refusal_of(no_mesh).find("this is no mesh"), std::string::npos);
    }

    TEST(GmshFiles, HigherOrderKeepsItsCorners)
    {
      const PlainMesh mesh = test::mesh_of(
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 0 0\n6 .5 .5 0\n7 0 .5 0\n"
          "8 0 0 .5\n9 0 .5 .5\n10 .6 0 .6\n$EndNodes\n$Elements\n2\n1 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n2 9 2 4 4 1 2 3 5 6 7\n"
          "$EndElements\n");
      EXPECT_EQ(mesh.straightened, 1u);
      ASSERT_EQ(mesh.cells.size(), 1u);
      EXPECT_EQ(mesh.cells[0].shape, PlainMesh::Shape::tetrahedron);
      EXPECT_NEAR(signed_volume(mesh, mesh.cells[0]), 1. / 6, 1e-15);
      ASSERT_EQ(mesh.faces.size(), 1u);
      EXPECT_EQ(mesh.faces[0].shape, PlainMesh::Shape::triangle);
    }

    /// A cell of two groups keeps both; the sign of a group, an orientation, is left out.
    TEST(GmshFiles, GroupsAreOfElements)
    {
      std::string text = test::gmsh_4(true, false);
      text.replace(text.find("21 0 0 0 1 1 1 1 1 2 31"), 23, "21 0 0 0 1 1 1 2 1 7 2 31");
      const PlainMesh mesh = test::mesh_of(text);
      EXPECT_EQ(mesh.further_groups.at(0), std::vector<int>{7});
      EXPECT_EQ(mesh.further_groups.size(), 1u);
    }
  } // namespace
} // namespace myolines
