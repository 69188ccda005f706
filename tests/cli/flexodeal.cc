#include "../support/places.h"
#include "program_runner.h"

#include <myolines/base/error.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/flexodeal.h>
#include <myolines/cli/prm_file.h>

#include <gtest/gtest.h>

using namespace myolines;

namespace
{
  const std::filesystem::path data = std::filesystem::path(myolines::test::source_folder()) / "tests/data/flexodeal";

  FlexodealOptions options(const TestFolder &folder)
  {
    FlexodealOptions files;
    files.parameters = data / "parameters.prm";
    files.strain     = data / "strain.dat";
    files.activation = data / "activation.dat";
    files.scene      = folder / "scene.xml";
    return files;
  }

  /// The parameters with the first @p from replaced.
  std::filesystem::path changed(const TestFolder &folder, const std::string &from, const std::string &to)
  {
    std::string text = contents(data / "parameters.prm");
    if (text.find(from) == std::string::npos)
      throw std::logic_error("no \"" + from + "\" in the parameters");
    return folder.write("changed.prm", text.replace(text.find(from), from.size(), to));
  }

  std::string refusal(const FlexodealOptions &options)
  {
    std::ostringstream out;
    try
      {
        import_flexodeal(options, out);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "accepted";
  }
} // namespace

TEST(Flexodeal, AMeshReplacesTheBody)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = options(folder);
  files.parameters         = changed(folder, "set Grid scale          = 1e-3", "set Grid scale = 1");
  files.mesh               = myolines::test::source_folder() + "/input/gastrocnemius_running/gastrocnemius.msh";
  files.ends               = {"proximal end", "distal end"};
  import_flexodeal(files, out);
  const scene::Node scene    = read_whole_scene(files.scene, {});
  const auto       &geometry = scene.section("system").section("geometry");
  EXPECT_EQ(geometry.text("type"), "mesh");
  EXPECT_EQ(geometry.text("scale"), "1");
  const auto &conditions = scene.section("system").section("boundary").named();
  EXPECT_EQ(conditions[0].text("face"), "distal end");
  EXPECT_EQ(conditions[1].text("face"), "proximal end");
  files.ends[1] = "nowhere";
  EXPECT_NE(refusal(files).find("no face \"nowhere\""), std::string::npos);
}

TEST(Flexodeal, ParametersBecomeAScene)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = options(folder);
  files.markers            = data / "markers.dat";
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

  EXPECT_EQ(scene.section("time").number("end"), 0.2) << "0.20000001 is how the peer writes 0.2";
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
  import_flexodeal(options(folder), out);
  for (const std::string entry :
       {"Pressure ratio p/p0 = 0", "Max iteration multiplier = 2", "Preconditioner relaxation = 0.65", "Tolerance displacement = 1e-9",
        "Output binary files main variables = true", "Markers list file = markers.dat"})
    EXPECT_NE(out.str().find(entry), std::string::npos) << entry;
  EXPECT_EQ(out.str().find("Tolerance force"), std::string::npos);
}

TEST(Flexodeal, ScheduleReplacesTheStepSize)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = options(folder);
  files.steps              = "4 x 0.025; 8 x 0.0125";
  import_flexodeal(files, out);
  const scene::Node time = read_whole_scene(files.scene, {}).section("time");
  EXPECT_DOUBLE_EQ(time.number("end"), 0.2);
  EXPECT_EQ(time.text("steps"), files.steps);
  EXPECT_FALSE(time.has("step"));
  files.steps = "4 times 0.025";
  EXPECT_NE(refusal(files).find("--steps"), std::string::npos);
}

TEST(Flexodeal, QuasiStaticParametersTakeTheStaticIntegrator)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = options(folder);
  files.parameters         = changed(folder, "= dynamic", "= quasi-static");
  import_flexodeal(files, out);
  EXPECT_EQ(read_whole_scene(files.scene, {}).section("integrator").text("type"), "static");
}

/// The number of whole steps, whatever the rounding of the quotient.
TEST(Flexodeal, EndIsAWholeNumberOfSteps)
{
  const TestFolder   folder;
  std::ostringstream out;
  FlexodealOptions   files = options(folder);
  files.parameters         = changed(folder, "End time       = 0.20000001", "End time = 0.21");
  import_flexodeal(files, out);
  EXPECT_DOUBLE_EQ(read_whole_scene(files.scene, {}).section("time").number("end"), 0.2);
  files.parameters = changed(folder, "End time       = 0.20000001", "End time = 0.2");
  import_flexodeal(files, out);
  EXPECT_DOUBLE_EQ(read_whole_scene(files.scene, {}).section("time").number("end"), 0.2);
}

TEST(Flexodeal, BadFilesAreRefusedWithFileAndLine)
{
  const TestFolder                              folder;
  const std::vector<std::array<std::string, 3>> changes{
      {{"set Muscle density ", "set Muscle densty ", "changed.prm, line 24: unknown entry \"Muscle densty\""}},
      {{"set Muscle density                  = 1060", "", "\"Muscle density\" of subsection \"Materials\" is not set"}},
      {{"set Length ", "put Length ", "changed.prm, line 9: \"put Length              = 30\" is not understood"}},
      {{"= 30\n", "= -30\n", "changed.prm, line 9: Length = \"-30\" cannot be carried over"}},
      {{"= 1060", "= heavy", "system/tissues/muscle/density: \"heavy\" is not a finite number"}},
      {{"= dynamic", "= static", "system/inertia: \"static\" is not a valid choice"}},
      {{"Pulling face ID = 1", "Pulling face ID = 4", "expected: an integer in [0, 1]"}},
      {{"= 0.20000001", "= 0.01", "at least one time step"}},
      {{"  set Max strain rate                 = 5.0\n", "  set Muscle density = 1\n", "set again, after line 24"}},
      {{"set Output binary files tensors        = false\nend", "", "is not closed"}}};
  for (const auto &[from, to, message] : changes)
    {
      FlexodealOptions files = options(folder);
      files.parameters       = changed(folder, from, to);
      EXPECT_NE(refusal(files).find(message), std::string::npos) << message << " not in\n" << refusal(files);
    }
  FlexodealOptions files = options(folder);
  files.strain           = folder.write("strain.dat", "0 0\n0.1 x\n");
  EXPECT_NE(refusal(files).find("strain.dat, line 2"), std::string::npos);
  files.strain = folder.write("strain.dat", "0 0\n0.2 1\n0.1 0\n");
  EXPECT_NE(refusal(files).find("unsorted"), std::string::npos);
  files         = options(folder);
  files.markers = folder.write("markers.dat", "a 0 0\n");
  EXPECT_NE(refusal(files).find("markers.dat, line 1"), std::string::npos);
  files       = options(folder);
  files.scene = folder / "no such folder" / "scene.xml";
  EXPECT_NE(refusal(files).find("no such folder"), std::string::npos);
}

TEST(Prm, SubsectionsCommentsAndContinuations)
{
  const TestFolder folder;
  const auto entries = read_prm(folder.write("a.prm", "set a = 1 # one\nsubsection x\n subsection y z\n  set b  =  2 \\\n 3\n end\nend\n"));
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].section + "|" + entries[0].name + "|" + entries[0].text, "|a|1");
  EXPECT_EQ(entries[1].section + "|" + entries[1].name + "|" + entries[1].text, "x/y z|b|2  3");
}
