// SPDX-License-Identifier: LGPL-2.1-or-later
// Input files of Abaqus.
#include "example.h"

#include <gtest/gtest.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    std::string nodes()
    {
      std::ostringstream text;
      text << "*HEADING\n by a test\n** a comment\n*NODE, NSET=ALL\n";
      for (int i = 0; i < 12; ++i)
        {
          const auto x = test::TwoCubes::point(i);
          text << test::TwoCubes::number(i) << ", " << x[0] << ",  " << x[1] << ", " << x[2] << "\n";
        }
      return text.str();
    }

    std::string listed(const int *points, const int n)
    {
      std::string text;
      for (int v = 0; v < n; ++v)
        text += ", " + std::to_string(test::TwoCubes::number(points[v]));
      return text + "\n";
    }

    std::string element(const int number, const int cell) { return std::to_string(number) + listed(test::TwoCubes::cell[cell], 8); }

    /// Cells 1, 2; "a" is the first and "b" the second in the order of names.
    std::string cells() { return "*Element, type=C3D8R, elset=a\n" + element(1, 0) + "*Element, type=C3D8R, elset=b\n" + element(2, 1); }

    /// By sides of elements, by elements of their own, or by nodes, the names of the ends come third and fourth.
    std::vector<std::string> all_ways()
    {
      const std::string quads = "*ELEMENT, TYPE=CPS4, ELSET=c\n7" + listed(test::TwoCubes::face[0], 4) + "*ELEMENT, TYPE=S4R, ELSET=d\n8" +
                                listed(test::TwoCubes::face[1], 4);
      const std::string sides = "*SURFACE, NAME=c, TYPE=ELEMENT\na, S6\n*SURFACE, TYPE=ELEMENT, NAME=d\n2, S4\n";
      const std::string sets  = "*NSET, NSET=c\n5, 20,\n35, 50\n*NSET, NSET=d, GENERATE\n15, 60, 15\n*NSET, NSET=one\n5\n";
      return {nodes() + cells() + quads, nodes() + cells() + sides + "*STEP\n*STATIC\n1., 1.\n*END STEP\n", nodes() + cells() + sets};
    }

    TEST(AbaqusFiles, SurfacesAreSidesElementsOrNodes)
    {
      for (const std::string &text : all_ways())
        {
          PlainMesh mesh = test::mesh_of(text);
          ASSERT_EQ(mesh.cells.size(), 2u) << text;
          ASSERT_EQ(mesh.faces.size(), 2u) << text;
          EXPECT_EQ(mesh.cell_groups, (std::map<int, std::string>{{1, "a"}, {2, "b"}}));
          EXPECT_EQ(mesh.face_groups.at(mesh.faces[0].group), "c");
          EXPECT_EQ(mesh.face_groups.at(mesh.faces[1].group), "d");
          for (int f = 0; f < 2; ++f)
            for (int v = 0; v < 4; ++v)
              {
                const auto x = mesh.points[mesh.faces[f].corner[v]];
                EXPECT_EQ(x[0], 2.5 * f) << text;
              }
          for (int v = 0; v < 8; ++v)
            EXPECT_EQ(mesh.points[mesh.cells[1].corner[v]], test::TwoCubes::point(test::TwoCubes::cell[1][v]));
        }
    }

    TEST(AbaqusFiles, ElementsGoOverLinesAndBelongToSets)
    {
      const PlainMesh mesh =
          test::mesh_of("*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,.5,0,0\n6,.5,.5,0\n7,0,.5,0\n8,0,0,.5\n9,.5,0,.5\n10,0,.5,.5\n"
                        "*ELEMENT,TYPE=C3D10M\n4,1,2,3,4,5,\n6,7,8,9,10\n*ELSET,ELSET=muscle\n4\n*ELSET,ELSET=whole\nmuscle\n");
      ASSERT_EQ(mesh.cells.size(), 1u);
      EXPECT_EQ(mesh.cells[0].shape, PlainMesh::Shape::tetrahedron);
      EXPECT_EQ(mesh.straightened, 1u);
      EXPECT_EQ(mesh.further_groups.at(0), std::vector<int>{2});
    }

    TEST(AbaqusFiles, KeywordsGoOverLines)
    {
      const PlainMesh mesh = test::mesh_of(nodes() + "*Element,\n type=C3D8R,\n elset=a\n" + element(1, 0));
      ASSERT_EQ(mesh.cells.size(), 1u);
      EXPECT_EQ(mesh.cell_groups.at(mesh.cells[0].group), "a");
    }

    /// Moved by (1, 2, 3), then turned by 90 degrees about the line along z through (1, 0, 0): x and y become 1 - y and x - 1.
    TEST(AbaqusFiles, InstancesAreMovedAndTurned)
    {
      const auto assembled = [](const std::string &motion) {
        return "*PART, NAME=P\n" + nodes() + cells() + "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n" + motion +
               "*END INSTANCE\n*NODE\n5, 99, 99, 99\n*END ASSEMBLY\n";
      };
      const PlainMesh there = test::mesh_of(assembled("")), moved = test::mesh_of(assembled("1., 2., 3.\n")),
                      turned = test::mesh_of(assembled("1., 2., 3.\n1., 0., 0., 1., 0., 7., 90.\n"));
      ASSERT_EQ(there.points.size(), 12u); // without the point of reference of the assembly
      for (std::size_t i = 0; i < there.points.size(); ++i)
        {
          const auto &x = there.points[i], &t = turned.points[i];
          EXPECT_EQ(moved.points[i], (PlainMesh::Position{{x[0] + 1, x[1] + 2, x[2] + 3}}));
          EXPECT_NEAR(t[0], 1 - (x[1] + 2), 1e-14);
          EXPECT_NEAR(t[1], x[0] + 1 - 1, 1e-14);
          EXPECT_NEAR(t[2], x[2] + 3, 1e-14);
        }

      const double h       = std::sqrt(0.5);
      const auto   slanted = test::mesh_of(assembled("0, 0, 0\n0, 0, 0, 1, 1, 0, -180\n")); // swaps x and y, turns z
      for (std::size_t i = 0; i < there.points.size(); ++i)
        {
          const auto  &x = there.points[i], &t = slanted.points[i];
          const double along = h * (x[0] + x[1]);
          EXPECT_NEAR(t[0], 2 * h * along - x[0], 1e-14);
          EXPECT_NEAR(t[1], 2 * h * along - x[1], 1e-14);
          EXPECT_NEAR(t[2], -x[2], 1e-14);
        }
      for (const std::string motion : {"1, 2\n", "0, 0, 0\n1, 2, 3\n", "0, 0, 0\n1, 0, 0, 1, 0, 1, 5\n0, 0, 0\n"})
        EXPECT_NE(test::refusal_of(assembled(motion)).find("of the motion of an instance has"), std::string::npos) << motion;
      EXPECT_NE(test::refusal_of(assembled("0, 0, 0\n1, 0, 0, 1, 0, 0, 5\n")).find("both points of the axis"), std::string::npos);
      EXPECT_NE(test::refusal_of(assembled("0, 0, zero\n")).find("\"zero\" stands where a number of a motion"), std::string::npos);
    }

    TEST(AbaqusFiles, NamesAreEqualInAnyCaseAndMayNameTheirInstance)
    {
      const std::string head = "*Part, name=P\n" + nodes() + cells() +
                               "*End Part\n*Assembly, name=A\n*Instance, name=Belly-1, part=P\n*End Instance\n",
                        sides  = "*Elset, elset=first, instance=Belly-1\n1,\n*Surface, type=ELEMENT, name=c\nBelly-1.First, S6\n"
                                 "*Surface, type=ELEMENT, name=d\nBELLY-1.2, S4\n",
                        points = "*Nset, nset=c\nBelly-1.5, BELLY-1.20, Belly-1.35, Belly-1.50\n*Nset, nset=D, instance=Belly-1\n15, 30\n"
                                 "*Nset, nset=d, instance=Belly-1\n45, 60\n";
      for (const std::string &text : {head + sides + "*End Assembly\n", head + points + "*End Assembly\n"})
        {
          const PlainMesh mesh = test::mesh_of(text);
          ASSERT_EQ(mesh.faces.size(), 2u) << text;
          std::map<std::string, double> places;
          for (const auto &face : mesh.faces)
            places[mesh.face_groups.at(face.group)] = mesh.points[face.corner[0]][0];
          EXPECT_EQ(places["c"], 0) << text;
          EXPECT_EQ(places.count("d") + places.count("D"), 1u) << text;
          EXPECT_EQ(places["d"] + places["D"], 2.5) << text;
        }
      EXPECT_NE(test::refusal_of("*Part, name=P\n" + nodes() + "*End Part\n*Part, name=Q\n" + nodes()).find("nodes of several parts"),
                std::string::npos);
    }

    TEST(AbaqusFiles, SurfacesWithoutSidesAreTheFreeOnes)
    {
      const PlainMesh                            mesh = test::mesh_of(nodes() + cells() + "*Surface, name=c\na,\n*Surface, name=d\n2\n");
      std::map<std::string, std::vector<double>> ends; // the least and the greatest x of each face
      for (const auto &face : mesh.faces)
        for (int v = 0; v < 4; ++v)
          ends[mesh.face_groups.at(face.group)].push_back(mesh.points[face.corner[v]][0]);
      EXPECT_EQ(ends["c"].size(), 20u); // five sides of each, the one between them left out
      EXPECT_EQ(ends["d"].size(), 20u);
      EXPECT_EQ(*std::max_element(ends["c"].begin(), ends["c"].end()), 1.25);
      EXPECT_EQ(*std::min_element(ends["d"].begin(), ends["d"].end()), 1.25);
    }

    TEST(AbaqusFiles, MassesSpringsAndLinesArePassedOver)
    {
      const PlainMesh mesh = test::mesh_of(nodes() + cells() +
                                           "*ELEMENT, TYPE=MASS, ELSET=m\n98, 5\n*MASS, ELSET=m\n0.1\n*ELEMENT, TYPE=B31\n"
                                           "99, 5, 10\n*ELEMENT, TYPE=SPRINGA, ELSET=s\n100, 5, 10\n*ELEMENT, TYPE=CONN3D2\n101, , 10\n"
                                           "*ELEMENT, TYPE=S4, ELSET=c\n7" +
                                           listed(test::TwoCubes::face[0], 4));
      EXPECT_EQ(mesh.cells.size(), 2u);
      EXPECT_EQ(mesh.faces.size(), 1u);
    }

    TEST(AbaqusFiles, ExponentsMayBeThoseOfFortran)
    {
      const PlainMesh mesh = test::mesh_of("*NODE\n1,0,0,0\n2,1.5D-02,0,0\n3,0,2.d+1,0\n4,0,0,1e-2\n*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n");
      EXPECT_EQ(mesh.points[1][0], 0.015);
      EXPECT_EQ(mesh.points[2][1], 20);
      for (const char *word : {"1.5D", "1.5D+", "D-02", "1.5DD2", "1.5D2D2"})
        EXPECT_NE(test::refusal_of("*NODE\n1,0,0," + std::string(word) + "\n").find("a coordinate"), std::string::npos) << word;
    }

    TEST(AbaqusFiles, NoDamageDoesAnyHarm)
    {
      for (const std::string &text : all_ways())
        for (std::size_t n = 0; n < text.size(); n += 2)
          {
            test::refusal_of(text.substr(0, n));
            std::string changed = text;
            changed[n]          = static_cast<char>(changed[n] ^ 0x15);
            test::refusal_of(changed);
          }
    }

    TEST(AbaqusFiles, RefusalsNameThePlace)
    {
      const auto told = [](const std::string &text, const std::string &words) {
        const std::string refusal = test::refusal_of(text);
        EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
      };
      told("*NODE\n1, 0, 0, zero\n", "mesh, line 2: \"zero\" stands where a coordinate should be");
      told(nodes() + "*ELEMENT, TYPE=C3D8\n1, 5, 10\n", "the last element has only 2 nodes");
      told(nodes() + "*ELEMENT, TYPE=C3D77\n", "elements of type \"C3D77\" are not known");
      told(nodes() + "*ELEMENT, TYPE=C3D4\n1, 5, 10, 15, 99\n", "has the point 99");
      told(nodes() + cells() + "*SURFACE, NAME=c, TYPE=ELEMENT\nb, SPOS\n", "\"SPOS\" is no side of the element 2");
      told(nodes() + cells() + "*SURFACE, NAME=c, TYPE=ELEMENT\na, S7\n", "\"S7\" is no side of the element 1");
      told("*INCLUDE, INPUT=other.inp\n", "the keyword *INCLUDE is not read");
      told(nodes() + cells() + "*ELCOPY, ELEMENT SHIFT=9, OLD SET=a, SHIFT NODES=9\n", "the keyword *ELCOPY is not read");
      told("*NODE, INPUT=nodes.dat\n", "*NODE takes its data from the file \"nodes.dat\"");
      told("*NODE, SYSTEM=C\n1, 0.5, 90, 0\n", "the nodes are in the coordinate system \"C\"");
      told(nodes() + "*NSET, NSET=c, GENERATE\n1, 9000000000, 1\n", "a set goes from 1 to 9000000000");
    }
  } // namespace
} // namespace myolines
