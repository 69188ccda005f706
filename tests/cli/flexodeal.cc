// SPDX-License-Identifier: LGPL-2.1-or-later
#include "flexodeal_files.h"

#include <myolines/cli/prm_file.h>

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::test;

/// Faces are found by number, strains are parts of a length among the parameters, and the sheets have the direction of its body.

/// "Pulling face ID" 0 is the face that is held; others are pulled along x.

TEST(Flexodeal, TheHeldFaceIsNotPulled)
{
  const TestFolder folder;
  FlexodealOptions files = flexodeal_options(folder);
  files.parameters       = changed(folder, "Pulling face ID = 1", "Pulling face ID = 0");
  scene::Node system     = system_of(files);
  ASSERT_EQ(system.section("boundary").named().size(), 1u);
  EXPECT_EQ(system.section("boundary").named()[0].text("face"), "x-");
  files.parameters = changed(folder, "Pulling face ID = 1", "Pulling face ID = 3");
  system           = system_of(files);
  EXPECT_EQ(system.section("boundary").named()[0].text("face"), "y+");
  EXPECT_EQ(system.section("boundary").named()[0].text("direction"), "1 0 0");
}

TEST(Flexodeal, OlderParametersHaveThreePoints)
{
  const TestFolder folder;
  FlexodealOptions files = flexodeal_options(folder);
  files.parameters       = changed(folder, "set Markers list file = markers.dat",
                                   "set Left X = 0.01\nset Left Y = 0\nset Left Z = 0\nset Mid X = 0.015\nset Mid Y = 0\nset Mid Z = 0.004\n"
                                         "set Right X = 0.03\nset Right Y = 0.01\nset Right Z = 0");
  system_of(files);
  EXPECT_EQ(read_whole_scene(files.scene, {}).section("output").section("series").text("markers"),
            "left 0.01 0 0; mid 0.015 0 0.004; right 0.03 0.01 0");
}

/// One constant: neo-Hookean; three: Yeoh; no fraction: it is in the table of points.

TEST(Flexodeal, TheLawOfFatFollowsItsConstants)
{
  const TestFolder  folder;
  FlexodealOptions  files = flexodeal_options(folder);
  const std::string entry = "  set Max strain rate",
                    usual = "  set Bulk modulus fat = 1e7\n  set Fat factor = 2\n  set Fat constant 1 = 300\n";
  files.parameters        = changed(folder, entry, usual + "  set Fat fraction = 0.1\n" + entry);
  const scene::Node one   = system_of(files).section("tissues").section("muscle").section("fat");
  EXPECT_EQ(one.text("type"), "neo-hookean");
  EXPECT_EQ(one.number("c1"), 300);
  EXPECT_EQ(one.number("factor"), 2);
  EXPECT_EQ(one.number("fraction"), 0.1);
  files.parameters        = changed(folder, entry, usual + "  set Fat constant 2 = 5000\n  set Fat constant 3 = -4000\n" + entry);
  const scene::Node three = system_of(files).section("tissues").section("muscle").section("fat");
  EXPECT_EQ(three.text("type"), "yeoh");
  EXPECT_EQ(three.number("c3"), -4000);
  EXPECT_EQ(three.number("fraction"), 0);
}

/// The earliest versions have ramps instead of files: -10 % of 30 mm at 6 mm/s in the middle of the first second takes half a second.

TEST(Flexodeal, TheEarliestParametersHaveRamps)
{
  const TestFolder  folder;
  std::string       text = contents(flexodeal_data / "parameters.prm");
  const std::string face = "set Pulling face ID = 1\n";
  text.replace(text.find(face), face.size(),
               face + "set Pull time start = 0\nset Pull time end = 1\nset Pull strain = -0.1\nset Pull strain rate = 0.006\n");
  text += "subsection Activation\n set Activation level = 40 # [%]\n set Activation start = 0.1\n set Activation end = 0.6\nend\n";
  FlexodealOptions files;
  files.parameters          = folder.write("ramps.prm", text);
  files.scene               = folder / "scene.xml";
  const scene::Node  system = system_of(files);
  const auto        &strain = system.section("boundary").named()[0].section("strain");
  std::istringstream points(strain.text("points"));
  double             from, to, nothing, all;
  char               semicolon;
  points >> from >> nothing >> semicolon >> to >> all;
  EXPECT_NEAR(from, 0.25, 1e-12);
  EXPECT_NEAR(to, 0.75, 1e-12);
  EXPECT_EQ(nothing, 0);
  EXPECT_EQ(all, -0.1);
  EXPECT_EQ(system.section("activation").text("points"), "0.1 0; 0.6 0.4");

  files.strain = flexodeal_data / "strain.dat";
  std::ostringstream out;
  import_flexodeal(files, out);
  EXPECT_NE(out.str().find("Pull strain = -0.1"), std::string::npos) << "the file comes first, and that is told";
  files.strain.clear();
  text.replace(text.find("rate = 0.006"), 12, "rate = 0.002");
  files.parameters = folder.write("ramps.prm", text);
  EXPECT_NE(flexodeal_refusal(files).find("Pull strain rate = \"0.002\" cannot be carried over\n  expected: at least 0.003"),
            std::string::npos)
      << flexodeal_refusal(files);
  files            = flexodeal_options(folder);
  files.activation = "";
  EXPECT_NE(flexodeal_refusal(files).find("ACTIVATION.dat is not given"), std::string::npos);
}

/// Positive pressures pull.

/// Tables of points as pandas and R write them, with a first column that numbers the rows.

TEST(Flexodeal, ParametersBecomeAScene)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = flexodeal_options(folder);
  files.markers            = flexodeal_data / "markers.dat";
  import_flexodeal(files, out);
  const scene::Node scene  = read_whole_scene(files.scene, {});
  const auto       &system = scene.section("system");

  EXPECT_EQ(system.text("inertia"), "dynamic");
  EXPECT_EQ(scene.section("integrator").text("type"), "backward euler");
  EXPECT_DOUBLE_EQ(system.section("geometry").number("length"), 0.03) << "scaled";
  EXPECT_DOUBLE_EQ(system.section("geometry").number("height"), 0.008);
  EXPECT_EQ(system.section("geometry").integer("refinement"), 1);
  EXPECT_EQ(system.section("discretisation").integer("quadrature points"), 5);
  EXPECT_EQ(system.section("tissues").section("muscle").section("base").number("stress scale"), 1.5e5);
  EXPECT_EQ(system.section("fibres").number("z"), 0.8);

  const auto &conditions = system.section("boundary").named();
  ASSERT_EQ(conditions.size(), 2u);
  EXPECT_EQ(conditions[0].name(), "moving end");
  EXPECT_EQ(conditions[0].text("face"), "x+");
  EXPECT_EQ(conditions[0].section("strain").text("points"), "0.0 0.0; 0.1 0.05; 0.2 0.05");
  EXPECT_EQ(conditions[1].name(), "fixed end");
  EXPECT_EQ(conditions[1].text("face"), "x-");

  EXPECT_EQ(scene.section("time").number("end"), 0.2) << "0.20000001 is how Flexodeal writes 0.2";
  EXPECT_EQ(scene.section("time").number("step"), 0.025);
  EXPECT_EQ(scene.section("time").text("boundary rates"), "scheme");
  EXPECT_EQ(scene.section("time").text("start velocity"), "impulse");
  EXPECT_EQ(scene.section("time").text("events"), "ignore");
  EXPECT_EQ(scene.section("solver").section("nonlinear").number("absolute tolerance"), 1e-8);
  EXPECT_EQ(scene.section("output").section("series").text("markers"), "middle 0.015 0.005 0.004; end 0.03 0.005 0.004");
}

TEST(Flexodeal, WhatIsLostIsNamed)
{
  const TestFolder   folder;
  std::ostringstream out;
  import_flexodeal(flexodeal_options(folder), out);
  for (const std::string entry :
       {"Pressure ratio p/p0 = 0", "Max iteration multiplier = 2", "Preconditioner relaxation = 0.65", "Tolerance displacement = 1e-9",
        "Output binary files main variables = true", "Markers list file = markers.dat"})
    EXPECT_NE(out.str().find(entry), std::string::npos) << entry;
  EXPECT_EQ(out.str().find("Tolerance force"), std::string::npos);
  FlexodealOptions files = flexodeal_options(folder);
  files.parameters       = complete(folder, "");
  import_flexodeal(files, out);
  EXPECT_NE(out.str().find("not carried over (this body does not use them): Sigma naught tendon = 2e5"), std::string::npos);
}

TEST(Flexodeal, ScheduleReplacesTheStepSize)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = flexodeal_options(folder);
  files.steps              = "4 x 0.025; 8 x 0.0125";
  import_flexodeal(files, out);
  const scene::Node time = read_whole_scene(files.scene, {}).section("time");
  EXPECT_DOUBLE_EQ(time.number("end"), 0.2);
  EXPECT_EQ(time.text("steps"), files.steps);
  EXPECT_FALSE(time.has("step"));
  files.steps = "4 times 0.025";
  EXPECT_NE(flexodeal_refusal(files).find("--steps"), std::string::npos);
}

TEST(Flexodeal, QuasiStaticParametersTakeTheStaticIntegrator)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = flexodeal_options(folder);
  files.parameters         = changed(folder, "= dynamic", "= quasi-static");
  import_flexodeal(files, out);
  EXPECT_EQ(read_whole_scene(files.scene, {}).section("integrator").text("type"), "static");
}

/// Flexodeal adds up times, and makes the steps that end before its end: 41 times 0.025 is not below 1.025, and ten times 0.1, as rounded,
/// is below 1.
TEST(Flexodeal, StepsEndBeforeTheEnd)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = flexodeal_options(folder);
  files.parameters         = changed(folder, "End time       = 0.20000001", "End time = 0.21");
  import_flexodeal(files, out);
  EXPECT_DOUBLE_EQ(read_whole_scene(files.scene, {}).section("time").number("end"), 0.2);
  EXPECT_NE(out.str().find("the scene ends at 0.2 s, with the last step"), std::string::npos) << out.str();
  const auto end = [&](const std::string &theirs, const std::string &step) {
    std::string text = contents(flexodeal_data / "parameters.prm");
    text.replace(text.find("0.20000001"), 10, theirs);
    text.replace(text.find("= 0.025\n"), 8, "= " + step + "\n");
    files.parameters = folder.write("changed.prm", text);
    out.str("");
    import_flexodeal(files, out);
    return read_whole_scene(files.scene, {}).section("time").number("end");
  };
  EXPECT_DOUBLE_EQ(end("1.025", "0.025"), 1);
  EXPECT_NE(out.str().find("changed: Time / End time = 1.025; the scene ends at 1 s"), std::string::npos) << out.str();
  EXPECT_DOUBLE_EQ(end("1", "0.1"), 1);
  EXPECT_EQ(out.str().find("changed: Time"), std::string::npos) << out.str();
  EXPECT_DOUBLE_EQ(end("0.525", "0.025"), 0.5);
}

/// What has no counterpart in a file is "-" on the command line.
TEST(Flexodeal, NoStrainWhereNothingIsPulled)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = flexodeal_options(folder);
  files.parameters         = changed(folder, "Pulling face ID = 1", "Pulling face ID = 0");
  files.strain             = "-";
  import_flexodeal(files, out);
  EXPECT_EQ(read_whole_scene(files.scene, {}).section("system").section("boundary").named().size(), 1u);
  files.parameters = flexodeal_data / "parameters.prm";
  EXPECT_NE(flexodeal_refusal(files).find("STRAIN.dat is not given"), std::string::npos);
}

TEST(Flexodeal, BadFilesAreRefusedWithFileAndLine)
{
  const TestFolder                              folder;
  const std::vector<std::array<std::string, 3>> changes{
      {{"set Muscle density ", "set Muscle densty ", "changed.prm, line 24: unknown entry \"Muscle densty\""}},
      {{"set Muscle density                  = 1060", "", "\"Muscle density\" of subsection \"Materials\" is not set"}},
      {{"set Length ", "put Length ", "changed.prm, line 9: \"put Length              = 30\" is not understood"}},
      {{"= 30\n", "= -30\n", "changed.prm, line 9: Length = \"-30\" cannot be carried over"}},
      {{"= 1060", "= heavy", "changed.prm, line 24: Muscle density: \"heavy\" is not a finite number"}},
      {{"= dynamic", "= static", "changed.prm, line 5: Type of simulation: \"static\" is not a valid choice"}},
      {{"Pulling face ID = 1", "Pulling face ID = 6", "the faces are, from 0 on: x-, x+"}},
      {{"subsection Materials", "subsection Material", "hint: it belongs to subsection \"Materials\""}},
      {{"  set Max strain rate ", "  set Fat factor = 1\n  set Max strain rate ",
        "\"Bulk modulus fat\" of subsection \"Materials\" is not set"}},
      {{"set Max strain rate ", "set Max strain rates ", "hint: nearest valid name: \"Max strain rate\""}},
      {{"subsection Time", "subsection Material properties\n set Shear modulus = 8e7\nend\nsubsection Time", "step 44"}},
      {{"# A pennate", "include more.prm\n# A pennate", "other files are not read"}},
      {{"= 0.20000001", "= 0.01", "more than one time step"}},
      {{"= 30\n", "= 3 cm\n", "hint: a number alone, without a unit"}},
      {{"  set Max strain rate                 = 5.0\n", "  set Muscle density = 1\n", "set again, after line 24"}},
      {{"set Output binary files tensors        = false\nend", "", "is not closed"}}};
  for (const auto &[from, to, message] : changes)
    {
      FlexodealOptions files = flexodeal_options(folder);
      files.parameters       = changed(folder, from, to);
      EXPECT_NE(flexodeal_refusal(files).find(message), std::string::npos) << message << " not in\n" << flexodeal_refusal(files);
    }
  FlexodealOptions files = flexodeal_options(folder);
  files.scene            = folder / "no such folder" / "scene.xml";
  EXPECT_NE(flexodeal_refusal(files).find("no such folder"), std::string::npos);
}

TEST(Prm, AFileOfAnotherKindIsOneProblem)
{
  const TestFolder folder;
  FlexodealOptions files    = flexodeal_options(folder);
  files.parameters          = folder.write("points.dat", "\n0 0\n1 2\n3 4\n");
  const std::string refusal = flexodeal_refusal(files);
  EXPECT_NE(refusal.find("points.dat: this is no parameter file: nothing is set in it"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("line 2 is not understood"), std::string::npos) << refusal;
  EXPECT_EQ(refusal.find("points.dat, line"), std::string::npos) << refusal;
}

TEST(Prm, SubsectionsCommentsAndContinuations)
{
  const TestFolder folder;
  const auto entries = read_prm(folder.write("a.prm", "set a = 1 # one\nSUBSECTION x\n subsection y z\n  set b  =  2 \\\n 3\n END\nend\n"));
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].section + "|" + entries[0].name + "|" + entries[0].text, "|a|1");
  EXPECT_EQ(entries[1].section + "|" + entries[1].name + "|" + entries[1].text, "x/y z|b|2  3");
}
