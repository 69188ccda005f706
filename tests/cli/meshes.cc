// SPDX-License-Identifier: LGPL-2.1-or-later
// Scenes of bodies from meshes, by the program.
#include "program_runner.h"

#include <gtest/gtest.h>

namespace meshes_by_the_program
{
  /// A box of two hexahedra, 30 x 10 x 10 of a unit, without any groups.
  const std::string bare =
      "$NOD\n12\n1 0 0 0\n2 15 0 0\n3 30 0 0\n4 0 10 0\n5 15 10 0\n6 30 10 0\n7 0 0 10\n8 15 0 10\n9 30 0 10\n10 0 10 10\n"
      "11 15 10 10\n12 30 10 10\n$ENDNOD\n$ELM\n2\n1 5 0 0 8 1 2 5 4 7 8 11 10\n2 5 0 0 8 2 3 6 5 8 9 12 11\n$ENDELM\n";

  std::string parameter(const std::string &name, const std::string &value)
  {
    return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
  }
  std::string list(const std::string &name, const std::string &inside)
  {
    return "<ParameterList name=\"" + name + "\">\n" + inside + "</ParameterList>\n";
  }

  const std::string ends =
      list("left", parameter("normal", "-1 0 0")) + list("right", parameter("normal", "1 0 0") + parameter("through", "0.03 0 0"));

  std::string scene(const std::string &faces, const std::string &conditions, const std::string &scale = "mm")
  {
    return list(
        "scene",
        list("system", parameter("type", "muscle 3d") +
                           list("geometry", parameter("type", "mesh") + parameter("file", "bare.msh") + parameter("scale", scale) +
                                                list("faces", faces)) +
                           list("fibres", parameter("type", "direction")) + list("boundary", conditions)) +
            list("integrator", parameter("type", "backward euler")) +
            list("time",
                 "<Parameter name=\"end\" type=\"double\" value=\"0.02\"/><Parameter name=\"step\" type=\"double\" value=\"0.01\"/>"));
  }
  std::string fixed(const std::string &face) { return list("held " + face, parameter("face", face) + parameter("type", "fixed")); }

  class Meshes : public ::testing::Test
  {
  protected:
    Meshes() { folder_.write("bare.msh", bare); }

    Outcome run(const std::string &command, const std::string &text, const std::string &more = "") const
    {
      folder_.write("scene.xml", text);
      return run_program(folder_, command + " scene.xml " + more);
    }

    TestFolder folder_;
  };

  TEST_F(Meshes, FacesAreNamedByPlace)
  {
    const Outcome done = run("run", scene(ends, fixed("left") + fixed("right")), "--out r");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(contents(folder_ / "r/reaction.csv").find("held right"), std::string::npos);
    const Outcome other = run("check", scene(ends, fixed("left") + fixed("rigth")));
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_NE(other.err.find("the body has no face \"rigth\""), std::string::npos) << other.err;
    EXPECT_NE(other.err.find("nearest: \"right\""), std::string::npos) << other.err;
  }

  /// Without any named face a body is run as it is, its boundary being "rest"; faces that it does not have are input errors.
  TEST_F(Meshes, NamesMayBeMissing)
  {
    EXPECT_EQ(run("run", scene("", ""), "--out free").exit_code, 0);
    EXPECT_EQ(run("run", scene("", fixed("rest")), "--out held").exit_code, 0);
    const Outcome face = run("check", scene("", ""), "--set \"output/series/force face=x+\"");
    EXPECT_EQ(face.exit_code, 2);
    EXPECT_NE(face.err.find("the body has no face \"x+\""), std::string::npos) << face.err;
    EXPECT_NE(face.err.find("the mesh names no surface"), std::string::npos) << face.err;
  }

  TEST_F(Meshes, HingesAreTold)
  {
    // the second box beside and above the first: they share the edge from point 8 to point 11
    folder_.write("bare.msh",
                  "$NOD\n14\n1 0 0 0\n2 15 0 0\n4 0 10 0\n5 15 10 0\n7 0 0 10\n8 15 0 10\n9 30 0 10\n10 0 10 10\n11 15 10 10\n"
                  "12 30 10 10\n13 15 0 20\n14 30 0 20\n15 15 10 20\n16 30 10 20\n$ENDNOD\n$ELM\n2\n1 5 0 0 8 1 2 5 4 7 8 11 10\n"
                  "2 5 0 0 8 8 9 12 11 13 14 16 15\n$ENDELM\n");
    const Outcome done = run("check", scene("", fixed("rest")));
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(done.out.find("hinges: the body has 2 parts that have only edges or points in common; one has a point at"), std::string::npos)
        << done.out;
  }

  TEST_F(Meshes, SizesThatNoMuscleHasAreWarnedOf)
  {
    const std::string warning = "Warning: the body is 30 m long";
    for (const char *const command : {"check", "run"})
      {
        const Outcome long_one = run(command, scene("", "", "m"));
        EXPECT_EQ(long_one.exit_code, 0) << long_one.err;
        EXPECT_NE(long_one.out.find(warning), std::string::npos) << long_one.out;
        EXPECT_NE(long_one.out.find("Millimetres were probably meant"), std::string::npos) << long_one.out;
      }
    const Outcome unknown = run("check", scene("", "", "furlong"));
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_NE(unknown.err.find("is neither a unit nor a factor"), std::string::npos) << unknown.err;
    const Outcome values =
        run("check", scene("", ""),
            "--set system/tissues/muscle/density=1.06 --set \"system/tissues/muscle/fibre/maximum isometric stress=200\"");
    EXPECT_NE(values.out.find("kPa instead of Pa? That would be 200000"), std::string::npos) << values.out;
    EXPECT_NE(values.out.find("g/cm^3 instead of kg/m^3? That would be 1060"), std::string::npos) << values.out;
  }

  /// A mesh that is written is the body that it was made of.
  TEST_F(Meshes, FibresNeedADirectionOrALine)
  {
    const std::string without = "--unset system/fibres";
    const Outcome     free    = run("check", scene("", ""), without);
    EXPECT_EQ(free.exit_code, 2);
    EXPECT_NE(free.err.find("the fibres of the mesh have no direction"), std::string::npos) << free.err;
    const Outcome held = run("check", scene(ends, fixed("left") + fixed("right")), without);
    EXPECT_EQ(held.exit_code, 0) << held.err;
    EXPECT_NE(held.out.find("line of action: from right to left, direction (-1 0 0), length 0.03 m"), std::string::npos) << held.out;
  }

  /// A state is one of the nodes of its mesh, whose file may keep its name.
  TEST_F(Meshes, StatesOfAnotherMeshAreRefused)
  {
    const std::string text = scene(ends, fixed("left"));
    ASSERT_EQ(run("run", text, "--out r --quiet").exit_code, 0);
    const std::string saved = "--set \"time/start state=saved\" --set \"time/saved state=r/checkpoint\" --set time/end=0.04";
    EXPECT_EQ(run("check", text, saved).exit_code, 0);
    EXPECT_EQ(run("run", text, "--out r --resume --quiet --set time/end=0.03").exit_code, 0);
    std::string moved = bare;
    moved.replace(moved.find("2 15 0 0"), 8, "2 14 0 0");
    folder_.write("bare.msh", moved);
    for (const Outcome &refused : {run("check", text, saved), run("run", text, "--out r --resume --set time/end=0.04")})
      {
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_NE(refused.err.find("bare.msh has changed since the state was saved"), std::string::npos) << refused.err;
      }
  }

  TEST_F(Meshes, WrittenMeshesAreTheSameBody)
  {
    const auto facts = [](const std::string &told) {
      std::istringstream lines(told.substr(told.find("System:")));
      std::string        kept;
      for (std::string line; std::getline(lines, line);)
        if (line.find("extent") != std::string::npos || line.find("cells") != std::string::npos ||
            line.find("quadrilaterals on") != std::string::npos)
          kept += line + "\n";
      return kept;
    };
    for (const char *const name : {"again.vtu", "again.msh"})
      {
        const Outcome written = run("mesh", scene(ends, ""), std::string("--set system/geometry/refinement=1 --out ") + name);
        ASSERT_EQ(written.exit_code, 0) << written.err;
        EXPECT_NE(written.out.find("16 hexahedra, 45 points"), std::string::npos) << written.out;
        const Outcome again = run("check", scene("", "", "m"), std::string("--set system/geometry/file=") + name);
        EXPECT_NE(facts(again.out).find("16 cells of muscle"), std::string::npos) << again.out << again.err;
        EXPECT_NE(facts(again.out).find("extent 0.03 x 0.01 x 0.01 m, volume 3e-06 m^3"), std::string::npos) << facts(again.out);
        EXPECT_NE(facts(again.out).find("4 quadrilaterals on the face \"right\""), std::string::npos) << facts(again.out);
      }
    EXPECT_EQ(run("mesh", scene(ends, ""), "--out mesh.stl").exit_code, 2);
  }
} // namespace meshes_by_the_program
